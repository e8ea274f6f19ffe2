// What each parameter buys: its main effect on error and on time.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "study/statistics.h"

namespace phos::inline study {

/// One run of a full factorial study.
struct Trial {
  std::vector<std::size_t> level;  ///< of each factor
  std::size_t seed = 0;            ///< which repeat
  double error = 0, seconds = 0;
  double resolution = 0;  ///< least error that the reference can tell from none; 0: any
};

/// A level of a factor against the first one: the ratio of errors and of times, all else equal.
struct LevelEffect {
  MeanInterval error, seconds;  ///< factors; 0.5 halves it
  std::size_t pairs = 0;        ///< of trials that are alike but for this factor
  std::size_t faint = 0;        ///< pairs with an error below the resolution, which stands in its place
  std::size_t left_out = 0;     ///< pairs with an error or time that has no logarithm
};

/// Effects of the levels of `factor`, the first of which is 1 by definition. Trials that differ in it alone
/// (other factors and seed equal) make pairs; log ratios are averaged over the pairs of one seed, and the
/// interval is Student's over the seeds, as trials of one seed share stages. One seed has no interval.
std::vector<LevelEffect> main_effect(std::span<const Trial> trials, std::size_t factor, std::size_t levels,
                                     double confidence);

}  // namespace phos::inline study
