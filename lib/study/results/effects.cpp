#include "study/results/effects.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace phos::inline study {

namespace {

/// What a trial shares with those it is compared with.
using Others = std::pair<std::size_t, std::vector<std::size_t>>;

Others others_of(const Trial& trial, std::size_t factor) {
  Others others{trial.seed, trial.level};
  others.second[factor] = 0;
  return others;
}

struct LogSums {
  double error = 0, seconds = 0;
  double n = 0;
};

MeanInterval ratio_interval(const std::vector<double>& logs, double confidence) {
  const MeanInterval log = mean_interval(logs, confidence);
  return {std::exp(log.mean), std::exp(log.lo), std::exp(log.hi), log.n};
}

double told(const Trial& t) { return std::max(t.error, t.resolution); }
bool has_logarithm(double v) { return v > 0 && std::isfinite(v); }

}  // namespace

std::vector<LevelEffect> main_effect(std::span<const Trial> trials, std::size_t factor, std::size_t levels,
                                     double confidence) {
  std::map<Others, const Trial*> first;
  for (const Trial& t : trials)
    if (t.level[factor] == 0) first[others_of(t, factor)] = &t;
  std::vector<LevelEffect> effects(levels);
  std::vector<std::map<std::size_t, LogSums>> by_seed(levels);
  for (const Trial& t : trials) {
    const auto found = first.find(others_of(t, factor));
    if (found == first.end()) continue;
    const Trial& base = *found->second;
    LevelEffect& effect = effects[t.level[factor]];
    if (!has_logarithm(told(t)) || !has_logarithm(told(base)) || !has_logarithm(t.seconds) ||
        !has_logarithm(base.seconds)) {
      ++effect.left_out;
      continue;
    }
    ++effect.pairs;
    if (t.error < t.resolution || base.error < base.resolution) ++effect.faint;
    LogSums& sums = by_seed[t.level[factor]][t.seed];
    sums.error += std::log(told(t) / told(base)), sums.seconds += std::log(t.seconds / base.seconds);
    ++sums.n;
  }
  for (std::size_t level = 0; level < levels; ++level) {
    std::vector<double> error, seconds;
    for (const auto& [seed, sums] : by_seed[level])
      error.push_back(sums.error / sums.n), seconds.push_back(sums.seconds / sums.n);
    effects[level].error = ratio_interval(error, confidence);
    effects[level].seconds = ratio_interval(seconds, confidence);
  }
  return effects;
}

}  // namespace phos::inline study
