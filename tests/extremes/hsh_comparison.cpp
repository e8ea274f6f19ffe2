// The other bases at the pole, on the horizon, at high orders, and for directions that are none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "hsh/comparison_bases.h"
#include "support/comparison_basis.h"

using namespace phos;
using namespace phos::test;

TEST(HshComparisonLimits, OrdersOutsideTheRangeAreRefused) {
  for (const ComparisonBasis basis : kComparisonBases) {
    for (const int order : {-3, 0, 101, 200}) {
      double out = 0;
      EXPECT_THROW(evaluate_comparison(basis, order, 0, 0, 1, &out), Error) << name(basis) << order;
      EXPECT_THROW(accuracy_by_order([](double, double, double) { return 1.; }, basis, order,
                                     hemisphere_quadrature(2, 2)),
                   Error)
          << name(basis) << order;
    }
  }
}

TEST(HshComparisonLimits, NoFiniteInputOverflows) {
  const double parts[] = {0, 1e-300, 0.6, 1, 1e300, std::numeric_limits<double>::infinity()};
  for (const ComparisonBasis basis : kComparisonBases) {
    for (const double x : parts)
      for (const double z : parts)
        for (const double sign : {1., -1.}) {
          for (const double v : values(basis, 100, x, -x, sign * z)) {
            ASSERT_TRUE(std::isfinite(v)) << name(basis) << " at " << x << " " << sign * z;
          }
        }
  }
}

TEST(HshComparisonLimits, NanStaysNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ComparisonBasis basis : kComparisonBases) {
    for (const auto& v : {values(basis, 3, 0, 0, nan), values(basis, 3, nan, 0, 0.5)}) {
      EXPECT_TRUE(std::any_of(v.begin(), v.end(), [](double c) { return std::isnan(c); })) << name(basis);
    }
  }
}

// Order 100, by m: over the azimuth the integral of cos^2(m phi) is pi, of 1 it is 2 pi; over z the
// functions are taken where the cosine is 1.
TEST(HshComparisonLimits, HighOrdersAreOrthonormal) {
  const int order = 100;
  const Quadrature q = hemisphere_quadrature(202, 1);
  for (const ComparisonBasis basis : kComparisonBases) {
    if (basis == ComparisonBasis::sh) continue;
    for (const int m : {0, 1, 50, 98}) {
      std::vector<std::size_t> some;
      for (int degree = m; degree < order; ++degree) {
        const int before = comparison_count(basis, degree),
                  count = comparison_count(basis, degree + 1) - before;
        const bool all = count == 2 * degree + 1;
        if (!all && (degree - m) % 2) continue;
        some.push_back(static_cast<std::size_t>(before + (all ? degree + m : (degree + m) / 2)));
      }
      const std::size_t n = some.size();
      std::vector<double> gram(n * n);
      for (std::size_t k = 0; k < q.size(); ++k) {
        const std::vector<double> v = values(basis, order, std::sqrt((1 - q.z[k]) * (1 + q.z[k])), 0, q.z[k]);
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = 0; j < n; ++j)
            gram[i * n + j] += q.weight[k] * v[some[i]] * v[some[j]] * (m == 0 ? 1 : 0.5);
      }
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          ASSERT_NEAR(gram[i * n + j], i == j ? 1 : 0, 1e-11) << name(basis) << " m " << m << " " << i << j;
    }
  }
}

TEST(HshComparisonLimits, ADarkFunctionIsHeldWhole) {
  for (const ComparisonBasis basis : kComparisonBases) {
    for (const double a : accuracy_by_order([](double, double, double) { return 0.; }, basis, 3,
                                            hemisphere_quadrature(3, 3))) {
      EXPECT_EQ(a, 1);
    }
  }
}
