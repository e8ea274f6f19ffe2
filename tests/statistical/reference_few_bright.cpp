// How often the interval of a mean is trusted, and how often it then holds the truth: rules of
// docs/methods.md#g6-2 and #g6-4, against shares that were measured elsewhere with 1500 runs of 4096 samples.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/random.h"
#include "reference/central_moments.h"
#include "reference/moments.h"
#include "scene/report/unsampled.h"

namespace phos {
namespace {

constexpr int kRuns = 300, kSamples = 4096;

struct Distribution {
  const char* name;
  std::function<double(RandomStream&)> draw;
  double mean;
  double flagged;   ///< share of runs, of the golden table
  double coverage;  ///< of mean +- 2 standard errors where it is not flagged; 0: too few such runs
};

double exponential(RandomStream& random) { return -std::log1p(-random.uniform_double()); }

double pareto(RandomStream& random, double index) {
  return std::pow(1 - random.uniform_double(), -1 / index);
}

/// `expected` hits in kSamples that hold 1 in the mean.
double hit(RandomStream& random, double expected) {
  const double p = expected / kSamples;
  return random.uniform_double() < p ? 1 / p : 0;
}

double lognormal(RandomStream& random) {
  const double r = std::sqrt(-2 * std::log1p(-random.uniform_double()));
  return std::exp(r * std::cos(2 * std::numbers::pi * random.uniform_double()));
}

TEST(FewBright, FlagsAsMeasured) {
  const std::vector<Distribution> all = {
      {"exponential", exponential, 1, 0, 0.954},
      {"lognormal 1", lognormal, std::exp(0.5), 0.042, 0.954},
      {"hits 1", [](RandomStream& r) { return hit(r, 1); }, 1, 1, 0},
      {"hits 10", [](RandomStream& r) { return hit(r, 10); }, 1, 0.997, 0},
      {"hits 30", [](RandomStream& r) { return hit(r, 30); }, 1, 0.0227, 0.98},
      {"hits 100", [](RandomStream& r) { return hit(r, 100); }, 1, 0, 0.953},
      {"smooth and hits 10", [](RandomStream& r) { return 0.5 * exponential(r) + 0.5 * hit(r, 10); }, 1,
       0.997, 0},
      {"smooth and hits 30", [](RandomStream& r) { return 0.5 * exponential(r) + 0.5 * hit(r, 30); }, 1,
       0.0127, 0.951},
      {"Pareto 1.5", [](RandomStream& r) { return pareto(r, 1.5); }, 3, 0.943, 0},
      {"Pareto 2.5", [](RandomStream& r) { return pareto(r, 2.5); }, 5 / 3., 0.395, 0.922},
      {"Pareto 4", [](RandomStream& r) { return pareto(r, 4); }, 4 / 3., 0.054, 0.946}};
  for (std::size_t d = 0; d < all.size(); ++d) {
    int flagged = 0, covered = 0;
    for (int run = 0; run < kRuns; ++run) {
      RandomStream random(d, Stage::test, static_cast<std::uint64_t>(run));
      random.start_bounce(0);
      Moments moments;
      CentralMoments spread;
      for (int i = 0; i < kSamples; ++i) {
        const double x = all[d].draw(random);
        moments.add(x), spread.add(x);
      }
      if (!trusted(spread))
        ++flagged;
      else
        covered += std::fabs(moments.mean() - all[d].mean) <= 2 * moments.standard_error();
    }
    const auto within = [](int count, int of, double share) {
      // Four deviations of the count, with the table's own, and a point for its rounding.
      const double deviation = std::sqrt(std::max(share * (1 - share), 0.002) * (1. / of + 1. / 1500));
      return std::fabs(static_cast<double>(count) / of - share) <= 4 * deviation + 0.01;
    };
    EXPECT_TRUE(within(flagged, kRuns, all[d].flagged)) << all[d].name << ": " << flagged;
    if (all[d].coverage > 0) {
      EXPECT_TRUE(within(covered, kRuns - flagged, all[d].coverage))
          << all[d].name << ": " << covered << " of " << kRuns - flagged;
    }
  }
}

TEST(FewBright, TenHitsAreTheLeastThatIntervalsHoldWith) {
  // k hits of Poisson mean m: k +- 2 sqrt(k) holds m. Exact, as in the table.
  const auto coverage = [](double m) {
    double sum = 0;
    for (int k = 0; k < 400; ++k)
      if (std::fabs(k - m) <= 2 * std::sqrt(k)) sum += std::exp(k * std::log(m) - m - std::lgamma(k + 1.));
    return sum;
  };
  for (const auto& [m, share] : {std::pair{0.1, 0.095163}, {0.5, 0.3933}, {1., 0.63153}, {2., 0.86357}})
    EXPECT_NEAR(coverage(m), share, 1e-5) << m;
  for (double m = kExpectedHits; m < 100; m += 0.5) EXPECT_GT(coverage(m), 0.89) << m;
  double least = 1;
  for (double m = 0.1; m < kExpectedHits; m += 0.1) least = std::min(least, coverage(m));
  EXPECT_LT(least, 0.1);
}

TEST(FewBright, MergedMomentsAreThoseOfAllSamples) {
  CentralMoments whole, parts[3], merged;
  RandomStream random(7, Stage::test, 0);
  random.start_bounce(0);
  for (int i = 0; i < 1000; ++i) {
    const double x = 1e6 + exponential(random);
    whole.add(x), parts[i % 7 % 3].add(x);
  }
  for (const CentralMoments& part : parts) merged.merge(part);
  EXPECT_NEAR(merged.mean(), whole.mean(), 1e-9 * whole.mean());
  EXPECT_NEAR(merged.squares(), whole.squares(), 1e-6 * whole.squares());
  EXPECT_NEAR(merged.fourths(), whole.fourths(), 1e-6 * whole.fourths());
}

TEST(FewBright, NoLightIsNotTrustedAndEvenLightIs) {
  CentralMoments dark, even;
  for (int i = 0; i < 100; ++i) dark.add(0), even.add(3);
  EXPECT_FALSE(trusted(dark));
  EXPECT_TRUE(trusted(even));
  EXPECT_FALSE(trusted(CentralMoments()));
}

}  // namespace
}  // namespace phos
