// Surface gradients of HSH from sums of HSH: against those of the basis itself.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/sampling.h"
#include "hsh/basis.h"
#include "hsh/slopes.h"

namespace phos {
namespace {

using Doubles = std::vector<double>;

struct Gradients {
  Doubles value, x, y;
};

Gradients of_basis(int order, const DVec3& w) {
  const HarmonicBasis<double> basis(order);
  const auto n = static_cast<std::size_t>(basis.count());
  Gradients g{Doubles(n), Doubles(n), Doubles(n)};
  Doubles z(n);
  basis.evaluate(BasisKind::hsh, w.x, w.y, w.z, g.value.data(), g.x.data(), g.y.data(), z.data());
  return g;
}

/// What HshSlopes makes of light from one direction, of the third colour alone.
Gradients of_sums(int order, const DVec3& w) {
  const HshSlopes slopes(order);
  const auto n = static_cast<std::size_t>(harmonic_count(order));
  const auto z = static_cast<float>(w.z);
  Doubles with_p, with_q;
  for (const double h : of_basis(order + 1, w).value) {
    for (int c = 0; c < 3; ++c) {
      with_p.push_back(c == 2 ? static_cast<double>(HshSlopes::p(z)) * h : 0);
      with_q.push_back(c == 2 ? static_cast<double>(HshSlopes::q(z)) * h : 0);
    }
  }
  Doubles x(3 * n), y(3 * n);
  slopes.subtract(with_p, with_q, 3, x, y);
  Gradients g{{}, Doubles(n), Doubles(n)};
  for (std::size_t i = 0; i < n; ++i) {
    g.x[i] = -x[3 * i + 2], g.y[i] = -y[3 * i + 2];
    EXPECT_EQ(0, x[3 * i]);
    EXPECT_EQ(0, y[3 * i + 1]);
  }
  return g;
}

void compare(int order, const DVec3& w, double tolerance) {
  const Gradients found = of_sums(order, w), truth = of_basis(order, w);
  for (std::size_t i = 0; i < found.x.size(); ++i) {
    EXPECT_NEAR(truth.x[i], found.x[i], tolerance) << "harmonic " << i << ", z " << w.z;
    EXPECT_NEAR(truth.y[i], found.y[i], tolerance) << "harmonic " << i << ", z " << w.z;
  }
}

TEST(HshSlopes, AreTheGradientsOfTheBasis) {
  for (const int order : {1, 2, 3, 10, 30}) {
    for (std::uint64_t i = 0; i < 50; ++i) {
      RandomStream random(1, Stage::test, i);
      // p and q are floats: to the rounding of those, times the greatest harmonics and their bands.
      compare(order, DVec3(sample_uniform_cone(random.uniform2(), 0.01f)), 2e-6 * order * order);
    }
  }
}

TEST(HshSlopes, HoldAtThePoleAndTheHorizon) {
  const auto at = [](double z) {
    const double s = std::sqrt((1 - z) * (1 + z));
    return DVec3(0.6 * s, -0.8 * s, z);
  };
  compare(10, at(1), 1e-4);
  // Two terms that nearly cancel: rounding grows as 1 / sqrt(z).
  compare(10, at(1e-4), 2e-3), compare(10, at(1e-6), 2e-2);
  // Below 2^-20 z is taken as that; the gradient is next to nothing beside its greatest, about 50.
  compare(10, at(0), 0.05);
}

}  // namespace
}  // namespace phos
