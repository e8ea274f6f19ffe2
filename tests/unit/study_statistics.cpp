// Intervals, fronts and effects of studies, against tables and by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "study/results/effects.h"
#include "study/results/pareto.h"
#include "study/statistics.h"

namespace phos {
namespace {

TEST(StudyStatistics, QuantilesAreThoseOfTables) {
  EXPECT_NEAR(student_t(0.95, 1), 12.7062, 1e-4);
  EXPECT_NEAR(student_t(0.95, 2), 4.30265, 1e-5);
  EXPECT_NEAR(student_t(0.99, 9), 3.24984, 1e-5);
  EXPECT_NEAR(normal_quantile(0.95), 1.959964, 1e-6);
}

TEST(StudyStatistics, MeanOfRepeats) {
  // Mean 4, deviation 2, standard error 2 / sqrt(3).
  const double values[] = {2, 4, 6};
  const MeanInterval i = mean_interval(values, 0.95);
  EXPECT_DOUBLE_EQ(i.mean, 4);
  EXPECT_NEAR(i.hi - 4, 4.30265 * 2 / std::sqrt(3.0), 1e-4);
  EXPECT_DOUBLE_EQ(i.hi - 4, 4 - i.lo);
  EXPECT_EQ(i.n, 3u);
}

TEST(StudyStatistics, WhatRepeatsShareIsAddedInQuadrature) {
  const double values[] = {2, 4, 6};
  const double own = mean_interval(values, 0.95).hi - 4;
  EXPECT_NEAR(mean_interval(values, 0.95, 3).hi - 4, std::hypot(own, 1.959964 * 3), 1e-5);
  EXPECT_NEAR(mean_interval(std::span(values, 1), 0.95, 3).hi - 2, 1.959964 * 3, 1e-5);
}

TEST(StudyStatistics, OneValueHasNoInterval) {
  const double value[] = {2};
  const MeanInterval one = mean_interval(value, 0.95);
  EXPECT_EQ(one.mean, 2);
  EXPECT_FALSE(one.bounded());
  EXPECT_TRUE(std::isnan(mean_interval({}, 0.95).mean));
}

TEST(StudyStatistics, Medians) {
  const double three[] = {5, 1, 3}, four[] = {4, 1, 3, 2};
  EXPECT_EQ(median(three), 3);
  EXPECT_EQ(median(four), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(StudyPareto, KeepsWhatNothingBeats) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const CostAndError points[] = {{2, 5}, {1, 9}, {3, 5}, {4, 1}, {4, 2}, {inf, 0}, {0, nan}, {2, 5}, {5, 1}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1, 0, 7, 3}));
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(StudyPareto, NothingOfTheRestIsBetter) {
  std::vector<CostAndError> points;
  for (int i = 0; i < 200; ++i)
    points.push_back({std::fmod(i * 0.618034, 1), std::fmod(i * i * 0.414214, 1)});
  const std::vector<std::size_t> front = pareto_front(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool beaten = false;
    for (const CostAndError& p : points)
      beaten = beaten || (p.cost <= points[i].cost && p.error <= points[i].error &&
                          (p.cost < points[i].cost || p.error < points[i].error));
    EXPECT_EQ(beaten, std::find(front.begin(), front.end(), i) == front.end()) << i;
  }
}

/// error = 8 * 2^-a * 3^-b * (1 + seed), seconds = 2^a * 5^b: each factor multiplies by its own.
std::vector<Trial> product() {
  std::vector<Trial> trials;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t seed = 0; seed < 3; ++seed) {
        const auto x = static_cast<double>(a), y = static_cast<double>(b);
        trials.push_back({{a, b},
                          seed,
                          8 * std::pow(2, -x) * std::pow(3, -y) * (1 + static_cast<double>(seed)),
                          std::pow(2, x) * std::pow(5, y),
                          0});
      }
  return trials;
}

TEST(StudyEffects, FactorsThatMultiplyAreTakenApart) {
  const std::vector<LevelEffect> a = main_effect(product(), 0, 3, 0.95),
                                 b = main_effect(product(), 1, 2, 0.95);
  EXPECT_DOUBLE_EQ(a[0].error.mean, 1);
  EXPECT_DOUBLE_EQ(a[1].error.mean, 0.5);
  EXPECT_DOUBLE_EQ(a[2].error.mean, 0.25);
  EXPECT_DOUBLE_EQ(a[2].seconds.mean, 4);
  EXPECT_NEAR(b[1].error.mean, 1.0 / 3, 1e-15);
  EXPECT_DOUBLE_EQ(b[1].seconds.mean, 5);
  EXPECT_EQ(a[1].pairs, 6u);
  EXPECT_EQ(b[1].pairs, 9u);
  // Seeds agree: the interval is a point.
  EXPECT_NEAR(a[2].error.lo, 0.25, 1e-12);
  EXPECT_NEAR(a[2].error.hi, 0.25, 1e-12);
}

TEST(StudyEffects, IntervalIsOverSeeds) {
  // Log ratios by seed: -ln 2, -ln 2 - 0.3, -ln 2 + 0.3.
  std::vector<Trial> trials;
  const double shift[] = {0, -0.3, 0.3};
  for (std::size_t seed = 0; seed < 3; ++seed) {
    trials.push_back({{0}, seed, 1, 1, 0});
    trials.push_back({{1}, seed, 0.5 * std::exp(shift[seed]), 3, 0});
  }
  const LevelEffect e = main_effect(trials, 0, 2, 0.95)[1];
  EXPECT_NEAR(e.error.mean, 0.5, 1e-12);
  EXPECT_NEAR(std::log(e.error.hi / e.error.mean), 4.30265 * 0.3 / std::sqrt(3.0), 1e-5);
  EXPECT_FALSE(main_effect(std::span(trials).first(2), 0, 2, 0.95)[1].error.bounded());
}

TEST(StudyEffects, WhatTheReferenceCannotTellCountsAsItsLimit) {
  const std::vector<Trial> trials{{{0}, 0, 0.4, 1, 0.1}, {{1}, 0, 0.01, 1, 0.1}};
  const LevelEffect e = main_effect(trials, 0, 2, 0.95)[1];
  EXPECT_DOUBLE_EQ(e.error.mean, 0.25);
  EXPECT_EQ(e.faint, 1u);
}

TEST(StudyEffects, NoLogarithmNoPair) {
  const std::vector<Trial> trials{{{0}, 0, 0.4, 1, 0}, {{1}, 0, 0, 1, 0}};
  const LevelEffect e = main_effect(trials, 0, 2, 0.95)[1];
  EXPECT_EQ(e.pairs, 0u);
  EXPECT_EQ(e.left_out, 1u);
  EXPECT_TRUE(std::isnan(e.error.mean));
}

TEST(StudyEffects, SettingsThatFailedPairWithNothing) {
  std::vector<Trial> trials = product();
  trials.erase(trials.begin());  // a 0, b 0, seed 0
  EXPECT_EQ(main_effect(trials, 0, 3, 0.95)[1].pairs, 5u);
}

}  // namespace
}  // namespace phos
