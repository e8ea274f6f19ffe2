// Noise and bias are told apart, whatever the references' noise.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "plan/separate.h"

namespace phos {
namespace {

double normal(RandomStream& random) {
  return std::sqrt(-2 * std::log(1 - random.uniform_double())) *
         std::cos(2 * std::numbers::pi * random.uniform_double());
}

/// n values of 10 + `bias` with noise of deviation `sigma`.
std::vector<double> values(std::size_t n, double bias, double sigma, std::uint64_t seed) {
  std::vector<double> out;
  RandomStream random(seed, Stage::test, 0);
  for (std::size_t i = 0; i < n; ++i) {
    random.start_bounce(static_cast<std::uint32_t>(i % 60000));
    out.push_back(10 + (i % 2 ? bias : -bias) + sigma * normal(random));
  }
  return out;
}

TEST(StudyPlanSeparate, NoiseAndBias) {
  constexpr std::size_t n = 50000;
  const auto a = values(n, 0.3, 0.2, 1), b = values(n, 0.3, 0.2, 2), p = values(n, 0, 1, 3),
             q = values(n, 0, 1, 4);
  const Separated s = separate(a, b, p, q, 50);
  EXPECT_EQ(s.values, n);
  // Variance 0.04, known to sqrt(2 / n); bias squared 0.09, known to about (0.04 + 1 + 2 x 0.3) / sqrt(2 n).
  EXPECT_NEAR(s.noise2, 0.04, 5 * 0.04 * std::sqrt(2.0 / n));
  EXPECT_NEAR(s.bias2, 0.09, 5 * s.bias2_sigma);
  EXPECT_LT(s.bias2_sigma, 0.01);
  EXPECT_GT(s.bias2_sigma, 0.001);
  EXPECT_NEAR(s.reference2, 1, 0.05);
  EXPECT_NEAR(s.over(10).bias2, s.bias2 / 100, 1e-15);
  EXPECT_NEAR(s.total2(), 0.13, 0.03);
}

TEST(StudyPlanSeparate, SigmasAreThoseOfManyTrials) {
  double squares = 0, sigma2 = 0;
  constexpr int kTrials = 60;
  for (std::uint64_t t = 0; t < kTrials; ++t) {
    const std::size_t n = 2000;
    const Separated s = separate(values(n, 0, 0.5, 10 * t), values(n, 0, 0.5, 10 * t + 1),
                                 values(n, 0, 0.5, 10 * t + 2), values(n, 0, 0.5, 10 * t + 3), 20);
    squares += s.bias2 * s.bias2 / kTrials, sigma2 += s.bias2_sigma * s.bias2_sigma / kTrials;
  }
  EXPECT_NEAR(std::sqrt(squares / sigma2), 1, 5 / std::sqrt(2.0 * kTrials));
}

TEST(StudyPlanSeparate, ValuesThatAreNotFiniteAreLeftOut) {
  std::vector<double> a(8, 1), b(8, 1), p(8, 1), q(8, 1);
  a[3] = NAN, q[5] = HUGE_VAL;
  const Separated s = separate(a, b, p, q, 2);
  EXPECT_EQ(s.values, 6u);
  EXPECT_EQ(s.noise2, 0);
  EXPECT_EQ(s.bias2, 0);
  EXPECT_EQ(mean_magnitude(a, b), 1);
}

TEST(StudyPlanSeparate, PixelsOfLampsAreLeftOut) {
  Image image(9, 1), reference(9, 1);
  std::vector<Rgb> light(9, Rgb(1, 2, 3)), lamp(9, Rgb(0));
  lamp[4] = Rgb(5);
  image.set_rgb("", light), reference.set_rgb("", light), reference.set_rgb("emission", lamp);
  EXPECT_EQ(tiled_values(image, "", reference).size(), 24u);
  EXPECT_EQ(tiled_values(image, "", reference)[2], 3);
  const std::vector<double> none = tiled_values(image, "glossy", reference);
  EXPECT_EQ(none, std::vector<double>(24, 0.0));
}

}  // namespace
}  // namespace phos
