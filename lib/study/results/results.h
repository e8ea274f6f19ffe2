// What a study found: errors, times, sizes, fronts and effects.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/measure.h"
#include "study/results/effects.h"
#include "study/results/runs.h"
#include "study/run.h"
#include "study/statistics.h"

namespace phos::inline study {

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

StudyResults summarise(const StudyFile& study, const StudyWork& work, std::vector<RunResult> runs);

/// Sentences on differences that the reference cannot show, on the reference that would show them, and on
/// values that are not finite. Empty where all is well.
std::vector<std::string> doubts(const StudyResults& results);

}  // namespace phos::inline study
