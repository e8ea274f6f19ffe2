// Noise of projected samples. One sample estimates c_i by f H_i / p, and the squares of a basis add up to
// n^2 / (2 pi) everywhere, so the variances of the coefficients of N samples add up to
// (n^2 / (2 pi) int f^2 / p dw - |c|^2) / N.
#include "hsh/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

using namespace phos;

namespace {

constexpr double kPiD = std::numbers::pi;
constexpr int kOrder = 5, kSamples = 1000, kRuns = 400;

struct Samples {
  std::vector<double> x, y, z, value, pdf;
};

double light(double x, double, double z) { return std::exp(-4 * (1 - (0.5 * x + std::sqrt(0.75) * z))); }
double grazing_free(double x, double y, double z) { return z * light(x, y, z); }

using Light = double(double, double, double);

/// cosine: density z / pi, else uniform; stratified: 25 x 40 cells of equal probability, a sample in each.
Samples draw(Light* f, bool cosine, bool stratified, std::uint64_t run) {
  RandomStream random(1, Stage::test, run);
  Samples s;
  const int rows = stratified ? 25 : 1, columns = kSamples / 25;
  for (int k = 0; k < kSamples; ++k) {
    double u = random.uniform_double(), v = random.uniform_double();
    if (stratified) u = (k / columns + u) / rows, v = (k % columns + v) / columns;
    const double z = cosine ? std::sqrt(1 - u) : 1 - u, r = std::sqrt((1 - z) * (1 + z));
    s.x.push_back(r * std::cos(2 * kPiD * v)), s.y.push_back(r * std::sin(2 * kPiD * v)), s.z.push_back(z);
    s.value.push_back(f(s.x.back(), s.y.back(), z));
    s.pdf.push_back(cosine ? z / kPiD : 1 / (2 * kPiD));
  }
  return s;
}

struct Noise {
  double mean = 0, error = 0;             ///< of |c - exact|^2, and the standard error of that mean
  std::vector<double> bias_over_error{};  ///< by coefficient
};

Noise noise(Light* f, bool cosine, bool stratified, const std::vector<double>& exact) {
  Noise n;
  double square = 0;
  std::vector<double> sum(exact.size()), sum2(exact.size());
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    const Samples s = draw(f, cosine, stratified, run);
    const std::vector<double> c = project_samples(BasisKind::hsh, kOrder, s.x, s.y, s.z, s.value, s.pdf);
    double apart = 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const double d = c[i] - exact[i];
      apart += d * d;
      sum[i] += d, sum2[i] += d * d;
    }
    n.mean += apart / kRuns;
    square += apart * apart / kRuns;
  }
  n.error = std::sqrt((square - n.mean * n.mean) / kRuns);
  for (std::size_t i = 0; i < sum.size(); ++i) n.bias_over_error.push_back(sum[i] / std::sqrt(sum2[i]));
  return n;
}

struct Exact {
  std::vector<double> coefficients;
  double law = 0;
  Exact(Light* f, bool cosine) {
    const Quadrature q = hemisphere_quadrature(64, 64);
    coefficients = project(f, BasisKind::hsh, kOrder, q);
    for (std::size_t k = 0; k < q.size(); ++k) {
      const double v = f(q.x[k], q.y[k], q.z[k]), p = cosine ? q.z[k] / kPiD : 1 / (2 * kPiD);
      law += kOrder * kOrder / (2 * kPiD) * v * v / p * q.weight[k];
    }
    for (const double c : coefficients) law -= c * c;
    law /= kSamples;
  }
};

}  // namespace

TEST(HshProjection, NoiseOfUniformSamplesFollowsTheLaw) {
  const Exact exact(light, false);
  EXPECT_NEAR(exact.law, 0.01877, 1e-5);  // figure of an independent program
  const Noise n = noise(light, false, false, exact.coefficients);
  EXPECT_NEAR(n.mean, exact.law, 4 * n.error);
  EXPECT_LT(n.error, 0.05 * exact.law);
  for (const double z : n.bias_over_error) EXPECT_LT(std::fabs(z), 4);
}

TEST(HshProjection, NoiseOfCosineSamplesFollowsTheLaw) {
  const Exact exact(grazing_free, true);
  const Noise n = noise(grazing_free, true, false, exact.coefficients);
  EXPECT_NEAR(n.mean, exact.law, 4 * n.error);
  EXPECT_LT(n.error, 0.05 * exact.law);
  for (const double z : n.bias_over_error) EXPECT_LT(std::fabs(z), 4);
}

TEST(HshProjection, StrataTakeMostOfTheNoise) {
  const Exact exact(light, false);
  const Noise n = noise(light, false, true, exact.coefficients);
  EXPECT_LT(n.mean, exact.law / 16);
  for (const double z : n.bias_over_error) EXPECT_LT(std::fabs(z), 4);
}
