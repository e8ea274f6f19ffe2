// What a study found: errors, times, sizes, fronts and effects.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/measure.h"
#include "study/results/effects.h"
#include "study/run.h"
#include "study/statistics.h"

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
  std::string failed;  ///< what a program said; "": nothing did
};

/// One kind of result of one setting, over its seeds. Intervals are of StudyFile::confidence, for errors with
/// the noise of the reference in them.
struct Summary {
  std::size_t owner = 0;          ///< see Judgement
  MeanInterval error, bias, p99;  ///< relative (see MeasuredError)
  double rmse = 0;                ///< mean
  std::string unit;
  std::optional<double> noise, resolution;  ///< of the reference
  bool resolved = true;                     ///< is the mean error above the resolution?
  std::optional<double> stated, inside;
  std::optional<double> psnr_db, ssim;
  std::size_t non_finite = 0;
  MeanInterval seconds, cpu_s;
  MeanInterval time;  ///< the one of them that fronts, effects and plots are of
  double peak_bytes = 0, file_bytes = 0;
  /// On the front of its scene and camera: does nothing there beat it in error and that?
  bool best_in_time = false, best_in_memory = false, best_in_bytes = false;
  /// The error that fronts and plots show: one that cannot be told from none counts as the resolution.
  double told_error() const { return resolved ? error.mean : *resolution; }
};

struct PointResult {
  std::size_t setting = 0;
  std::optional<Summary> picture, lux;  ///< absent where every seed failed
  std::string failed;
  /// Null where another setting owns the result.
  const Summary* own(std::optional<Summary> PointResult::*kind) const {
    return this->*kind && (this->*kind)->owner == setting ? &*(this->*kind) : nullptr;
  }
};

/// Effects of one factor's levels.
struct FactorEffect {
  std::size_t factor = 0;
  std::vector<LevelEffect> levels;
};

struct StudyResults {
  std::vector<RunResult> runs;      ///< by setting, then seed
  std::vector<PointResult> points;  ///< of each setting
  std::vector<FactorEffect> picture_effects, lux_effects;
};

/// Reads pictures and tables and measures them. What failed is left out.
std::vector<RunResult> measure_runs(const StudyFile& study, const StudyWork& work,
                                    const StudyJournal& journal, const Failures& failures);
StudyResults summarise(const StudyFile& study, const StudyWork& work, std::vector<RunResult> runs);

/// Sentences on what the reference cannot tell, and what it would take, and on values that are not finite.
/// Empty where all is well.
std::vector<std::string> doubts(const StudyResults& results);

/// A row for each setting. Absent values are empty cells.
std::string results_csv(const StudyFile& study, const StudyWork& work, const StudyResults& results);
/// All of it: the study, every run with its costs, points, effects, and the command lines of each point.
Json results_json(const StudyFile& study, const StudyWork& work, const StudyJournal& journal,
                  const StudyResults& results);

}  // namespace phos::inline study
