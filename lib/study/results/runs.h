// Every run of a study: its costs, and the errors of its pictures and tables.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/measure.h"
#include "study/run.h"

namespace phos::inline study {

/// What a result takes: every stage that leads to it, each once.
struct ChainCost {
  double wall_s = 0, cpu_s = 0;
  double peak_bytes = 0;  ///< of the stage that takes most
  double file_bytes = 0;  ///< of the files between the scene and the result
};

/// A picture or a table of lux, of one setting and one seed.
struct Judgement {
  MeasuredError error;
  ChainCost cost;
  /// The first setting that ends in this very file (lux does not depend on the camera, nor a picture on
  /// options of phos-sense). Fronts, effects, plots and tables for people have a result once, as that one's.
  std::size_t owner = 0;
};

struct RunResult {
  std::size_t setting = 0, seed = 0;
  std::optional<Judgement> picture, lux;
  std::string failed;  ///< message of the program that failed; "": none did
};

/// Reads pictures and tables and measures them. What failed is left out.
std::vector<RunResult> measure_runs(const StudyFile& study, const StudyWork& work,
                                    const StudyJournal& journal, const Failures& failures);

}  // namespace phos::inline study
