// The error of sums over low-discrepancy samples.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/random.h"
#include "core/sampling.h"
#include "core/sequence_error.h"

namespace phos {
namespace {

using Integrand = std::function<double(const Vec2&)>;

/// True over stated root mean square error of sums of n points, over many starts. Sobol' points begin at
/// index 3 n.
double true_over_stated(const Integrand& f, int n, PointOrder::Kind kind = PointOrder::Kind::r2) {
  const PointOrder order{kind, kind == PointOrder::Kind::sobol ? 3 * n : 0};
  constexpr int kStarts = 2000;
  double sum = 0, squares = 0, stated = 0;
  for (int t = 0; t < kStarts; ++t) {
    RandomStream random(5, Stage::test, static_cast<std::uint64_t>(t));
    const Vec2 shift = random.uniform2();
    const std::uint32_t digits[2] = {random.bits(), random.bits()};
    std::vector<DVec3> parts;
    double value = 0;
    for (int k = 0; k < n; ++k) {
      const Vec2 u = kind == PointOrder::Kind::r2 ? r2_point(k, shift)
                                                  : sobol_point(order.first + k, digits[0], digits[1]);
      parts.emplace_back(f(u) / n);
      value += parts.back().x;
    }
    sum += value / kStarts, squares += value * value / kStarts;
    stated += sequence_variance(parts, true, order).x / kStarts;
  }
  return std::sqrt((squares - sum * sum) / stated);
}

TEST(Sequence, StatesAboutTheTrueErrorOfLampsAndShadows) {
  const auto lamp = [](double x,
                       double z) {  // a rectangle of 2 x 3 at a height of 1.5 over its corner + (x, z)
    return [=](const Vec2& u) {
      const double dx = 2 * double(u.x) - x, dz = 3 * double(u.y) - z, d2 = dx * dx + dz * dz + 2.25;
      return 2.25 / (d2 * d2);
    };
  };
  const auto edge = [](double angle, double at) {
    return [=](const Vec2& u) {
      return double(u.x) * std::cos(angle) + double(u.y) * std::sin(angle) < at ? 1.0 : 0.0;
    };
  };
  for (const int n : {8, 16, 64, 256}) {
    for (const Integrand& f : {Integrand(lamp(0, 0)), Integrand(lamp(-4, -4)), Integrand(edge(0.37, 0.7)),
                               Integrand(edge(1.1, 0.4)), Integrand(edge(0.785, 0.25))}) {
      const double ratio = true_over_stated(f, n);
      EXPECT_GT(ratio, 0.4) << n;
      EXPECT_LT(ratio, 1.8) << n;
    }
  }
  // These may be far better than neighbours tell: 32 points of a smooth function next to exact.
  for (const int n : {8, 12, 16, 40, 64, 256}) {
    for (const Integrand& f : {Integrand(lamp(0, 0)), Integrand(lamp(-4, -4)), Integrand(edge(0.37, 0.7)),
                               Integrand(edge(1.1, 0.4)), Integrand(edge(0.785, 0.25))}) {
      const double ratio = true_over_stated(f, n, PointOrder::Kind::sobol);
      EXPECT_GT(ratio, 0.3) << n;
      EXPECT_LT(ratio, 1.8) << n;
    }
  }
}

/// What the points know nothing of is as uncertain as independent samples of it.
TEST(Sequence, NoiseIsIndependent) {
  std::uint64_t item = 0;
  const Integrand noise = [&](const Vec2&) { return RandomStream(6, Stage::test, item++).uniform_double(); };
  for (const auto kind : {PointOrder::Kind::r2, PointOrder::Kind::sobol})
    for (const int n : {2, 3, 16, 100}) EXPECT_NEAR(true_over_stated(noise, n, kind), 1, 0.12) << n;
}

TEST(Sequence, WhatDoesNotVaryHasNoError) {
  EXPECT_EQ(sequence_variance({}, true), DVec3(0));
  for (const std::size_t n : {1u, 2u, 5u, 1000u})
    for (const bool in_plane : {true, false})
      EXPECT_EQ(sequence_variance(std::vector<DVec3>(n, DVec3(1, 2, 3)), in_plane), DVec3(0)) << n;
}

/// In any unit.
TEST(Sequence, ScalesWithItsParts) {
  std::vector<DVec3> parts, bright;
  for (int k = 0; k < 30; ++k) parts.emplace_back(std::sin(k), std::cos(k), k % 3);
  for (const double factor : {1e-30, 1e30}) {
    bright.clear();
    for (const DVec3& p : parts) bright.push_back(factor * p);
    const DVec3 one = sequence_variance(parts, true), other = sequence_variance(bright, true);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(other[c] / (factor * factor) / one[c], 1, 1e-9);
  }
}

}  // namespace
}  // namespace phos
