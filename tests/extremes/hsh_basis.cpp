// Harmonics where formulas in angles break: the pole, the horizon, high orders, directions that are none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "hsh/basis.h"
#include "hsh/projection.h"

using namespace phos;

namespace {

constexpr BasisKind kKinds[] = {BasisKind::sh, BasisKind::hsh};

template <class Real>
struct Values {
  std::vector<Real> v, gx, gy, gz, batch;
  Values(BasisKind kind, int order, Real x, Real y, Real z) {
    const HarmonicBasis<Real> basis(order);
    v.resize(static_cast<std::size_t>(basis.count()));
    gx = gy = gz = batch = v;
    basis.evaluate(kind, x, y, z, batch.data());
    basis.evaluate(kind, x, y, z, v.data(), gx.data(), gy.data(), gz.data());
    const bool a_number = !std::isnan(x) && !std::isnan(y) && !std::isnan(z);
    EXPECT_TRUE(!a_number || batch == v);
    basis.evaluate_batch(kind, 1, &x, &y, &z, batch.data());
    EXPECT_TRUE(!a_number || batch == v);
  }
  bool finite() const {
    for (const auto* list : {&v, &gx, &gy, &gz})
      for (const Real r : *list)
        if (!std::isfinite(r)) return false;
    return true;
  }
};

template <class Call>
void expect_usage_error(const Call& call) {
  try {
    call();
    ADD_FAILURE() << "accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}

template <class Real>
void expect_all_finite() {
  const Real most = std::numeric_limits<Real>::max(), least = std::numeric_limits<Real>::min(),
             infinity = std::numeric_limits<Real>::infinity();
  const Real parts[] = {0, least, static_cast<Real>(0.6), 1, most, infinity};
  for (const BasisKind kind : kKinds) {
    for (const int order : {1, 10, 100}) {
      for (const Real x : parts)
        for (const Real y : parts)
          for (const Real z : parts)
            for (const Real sign : {Real(1), Real(-1)}) {
              EXPECT_TRUE(Values<Real>(kind, order, x, -y, sign * z).finite())
                  << "order " << order << " at " << x << " " << -y << " " << sign * z;
            }
    }
  }
}

}  // namespace

TEST(HshBasisLimits, OrdersOutsideTheRangeAreRefused) {
  const Quadrature q = hemisphere_quadrature(2, 2);
  const std::vector<double> none, five(5), large(101 * 101);
  for (const int order : {-1, 0, 101, 200, 2000000000}) {
    expect_usage_error([&] { HarmonicBasis<float>{order}; });
    expect_usage_error([&] { HarmonicBasis<double>{order}; });
    expect_usage_error([&] { project([](double, double, double) { return 1.; }, BasisKind::hsh, order, q); });
    expect_usage_error([&] { project_samples(BasisKind::hsh, order, none, none, none, none, none); });
  }
  for (const auto& coefficients : {none, five, large}) {
    expect_usage_error([&] { reconstruct(coefficients, BasisKind::sh, 0, 0, 1); });
    expect_usage_error([&] { energy_by_band(coefficients); });
    expect_usage_error([&] { error_by_order(coefficients, 1); });
    std::vector<double> mine = coefficients;
    expect_usage_error([&] { apply_window(Window::hann, mine); });
  }
}

// Largest, smallest, infinite: no such vector is a direction, but none makes a number that is not one.
TEST(HshBasisLimits, NoFiniteInputOverflows) {
  expect_all_finite<float>();
  expect_all_finite<double>();
}

TEST(HshBasisLimits, NanStaysNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const BasisKind kind : kKinds) {
    for (const auto& w : {std::vector<double>{nan, 0, 1}, {0, nan, 1}, {0, 0, nan}}) {
      const Values<double> all(kind, 4, w[0], w[1], w[2]);
      double batch[16];
      HarmonicBasis<double>(4).evaluate_batch(kind, 1, &w[0], &w[1], &w[2], batch);
      const auto is_nan = [](double v) { return std::isnan(v); };
      EXPECT_TRUE(std::any_of(all.v.begin(), all.v.end(), is_nan));
      EXPECT_TRUE(std::any_of(batch, batch + 16, is_nan));
    }
  }
}

TEST(HshBasisLimits, BelowTheHorizonHshAreThoseOfTheHorizon) {
  const Values<double> at(BasisKind::hsh, 12, 0.6, 0.8, 0);
  for (const double z : {-1e-300, -1e-17, -0.3, -1.}) {
    const Values<double> below(BasisKind::hsh, 12, 0.6, 0.8, z);
    EXPECT_EQ(below.v, at.v) << z;
    EXPECT_EQ(below.gz, at.gz) << z;
  }
  // The whole horizon is one point: +-sqrt((2l + 1) / (2 pi)) for m = 0, and 0.
  for (int l = 0; l < 12; ++l) {
    for (int m = -l; m <= l; ++m) {
      const double expected = m ? 0 : (l % 2 ? -1 : 1) * std::sqrt((2 * l + 1) / (2 * M_PI));
      EXPECT_NEAR(at.v[static_cast<std::size_t>(harmonic_index(l, m))], expected, 1e-14);
    }
  }
}

// Next to the pole a float's z is 1, and all there is to know stands in x and y: H_1^1 is linear in x.
TEST(HshBasisLimits, NextToThePoleNothingIsLost) {
  for (const float x : {1e-3f, 1e-6f, 1e-12f, 1e-20f, 1e-37f}) {
    const float z = std::sqrt((1 - x) * (1 + x));
    const Values<float> sh(BasisKind::sh, 3, x, 0, z), hsh(BasisKind::hsh, 3, x, 0, z);
    EXPECT_NEAR(sh.v[3] / x, -std::sqrt(3 / (4 * M_PI)), 1e-6) << x;
    EXPECT_NEAR(hsh.v[3] / x, -std::sqrt(3 / M_PI), 1e-6 + static_cast<double>(x)) << x;
    EXPECT_NEAR(hsh.gx[3], -std::sqrt(3 / M_PI), 1e-5) << x;
  }
}

// Towards the horizon gz of H_1^1 grows as z^(-1/2); gx and gy do not.
TEST(HshBasisLimits, GradientTowardsTheHorizon) {
  const double constant = std::sqrt(3 / (2 * M_PI));  // H_1^1 = -constant 2 sqrt(z / (1 + z)) x
  for (const double z : {1e-2, 1e-4, 1e-8, 1e-16, 1e-300}) {
    const Values<double> v(BasisKind::hsh, 10, std::sqrt((1 - z) * (1 + z)), 0, z);
    EXPECT_NEAR(v.gz[3] * std::sqrt(z), -constant, 4 * z + 1e-15) << z;
    for (std::size_t i = 0; i < v.v.size(); ++i) {
      EXPECT_LT(std::fabs(v.gx[i]), 300) << i << " " << z;
      EXPECT_LT(std::fabs(v.gy[i]), 300) << i << " " << z;
    }
  }
  EXPECT_EQ(Values<double>(BasisKind::hsh, 3, 1, 0, 0).gz[3], 0);
}

// Orders where factorials have long overflowed; by the addition theorem the squares add up to a constant.
TEST(HshBasisLimits, HighOrdersInFloat) {
  for (const float z : {0.f, 1e-6f, 0.01f, 0.5f, 0.99f, 1.f}) {
    const float r = std::sqrt((1 - z) * (1 + z)), x = 0.6f * r, y = 0.8f * r;
    for (const BasisKind kind : kKinds) {
      double sum = 0;
      for (const float v : Values<float>(kind, 100, x, y, z).v)
        sum += static_cast<double>(v) * static_cast<double>(v);
      EXPECT_NEAR(sum / (1e4 / (kind == BasisKind::sh ? 4 * M_PI : 2 * M_PI)), 1, 2e-4) << z;
    }
  }
}
