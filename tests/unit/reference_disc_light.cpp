// The radius within which light paths about a sensor tell its light: wide where light is even, narrow beside
// an edge, and an error that knows of both.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "reference/disc_light.h"

namespace phos::test {
namespace {

constexpr double kLux = 100;
constexpr int kPasses = 32, kPaths = 2048;

double radius_m(std::size_t j) { return std::exp2(-0.5 * static_cast<double>(j)); }

std::array<double, kDiscRadii> areas() {
  std::array<double, kDiscRadii> area{};
  for (std::size_t j = 0; j < kDiscRadii; ++j) area[j] = M_PI * radius_m(j) * radius_m(j);
  return area;
}

/// Paths land evenly over a square of 2 x 2 m about the sensor; `lit(x, y)` says whether they bring light:
/// kLux where they do.
template <class Lit>
DiscLight::Estimate measure(const Lit& lit, std::uint64_t seed) {
  DiscLight light(areas());
  for (int pass = 0; pass < kPasses; ++pass) {
    DiscPass part;
    RandomStream random(seed, Stage::test, static_cast<std::uint64_t>(pass));
    for (int i = 0; i < kPaths; ++i) {
      const double x = 2 * random.uniform_double() - 1, y = 2 * random.uniform_double() - 1;
      if (!lit(x, y)) continue;
      for (std::size_t j = 0; j < kDiscRadii && std::hypot(x, y) <= radius_m(j); ++j)
        part.lux[j] += DVec3(kLux * 4 / kPaths), ++part.paths[j];
    }
    for (std::size_t j = 0; j < kDiscRadii; ++j) part.lux[j] /= areas()[j];
    light.add(DVec3(7), part);
  }
  return light.estimate();
}

template <class Lit>
double within_two_errors(const Lit& lit, double truth) {
  int within = 0;
  constexpr int kSeeds = 40;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const DiscLight::Estimate e = measure(lit, seed);
    within += std::fabs(e.illuminance_lx - 7 - truth) <= 2 * e.stderr_lx;
    EXPECT_GE(e.illuminance_lx, 7 - 1e-6);
  }
  return within / static_cast<double>(kSeeds);
}

TEST(DiscLight, EvenLightIsReadFromAfar) {
  const auto everywhere = [](double, double) { return true; };
  EXPECT_GT(within_two_errors(everywhere, kLux), 0.87);
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double off = measure(everywhere, seed).illuminance_lx - 7 - kLux;
    squares += off * off / 20;
  }
  EXPECT_LT(std::sqrt(squares), 0.05 * kLux) << "51,000 paths are within the largest radius";
}

/// 4 and 15 cm from an edge of light, on either side of it: the discs that reach over the edge are not taken,
/// or the error says so.
TEST(DiscLight, BesideAnEdge) {
  for (const double at : {0.04, 0.15}) {
    EXPECT_GT(within_two_errors([&](double x, double) { return x > at; }, 0), 0.8) << at;
    EXPECT_GT(within_two_errors([&](double x, double) { return x < at; }, kLux), 0.8) << at;
  }
}

TEST(DiscLight, NoneWhereNoPathComes) {
  const DiscLight::Estimate e = measure([](double, double) { return false; }, 1);
  EXPECT_NEAR(e.illuminance_lx, 7, 1e-6);
  EXPECT_EQ(e.stderr_lx, 0);
  DiscLight without;
  without.add(DVec3(3), {});
  EXPECT_NEAR(without.estimate().illuminance_lx, 3, 1e-6);
}

}  // namespace
}  // namespace phos::test
