// Bases that hemispherical harmonics are compared with: orthonormal, as their formulas say, and as accurate
// as an independent program found them.
#include "hsh/comparison_bases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "support/comparison_basis.h"
#include "support/lobes.h"

using namespace phos;
using namespace phos::test;
using enum ComparisonBasis;

namespace {

/// Of a lobe, at the degrees that have 25 coefficients; Zernike has 28. Even SH count those that are 0.
double accuracy(const DirectionalFunction& f, ComparisonBasis basis) {
  static const Quadrature q = hemisphere_quadrature(48, 96);
  return accuracy_by_order(f, basis, basis == zernike ? 7 : 5, q).back();
}

}  // namespace

TEST(HshComparison, BasesAreOrthonormalOnTheHemisphere) {
  const int order = 12;
  const Quadrature q = hemisphere_quadrature(3 * order, 2 * order);
  for (const ComparisonBasis basis : kComparisonBases) {
    if (basis == sh) continue;  // on the sphere
    const std::size_t n = static_cast<std::size_t>(comparison_count(basis, order));
    std::vector<double> gram(n * n);
    for (std::size_t k = 0; k < q.size(); ++k) {
      const std::vector<double> v = values(basis, order, q.x[k], q.y[k], q.z[k]);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) gram[i * n + j] += q.weight[k] * v[i] * v[j];
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        ASSERT_NEAR(gram[i * n + j], i == j ? 1 : 0, 1e-13) << name(basis) << " " << i << " " << j;
      }
    }
  }
}

TEST(HshComparison, LowDegreesAreTheClosedForms) {
  const double x = 0.48, y = -0.36, z = 0.8, pi = std::numbers::pi;
  const std::vector<double> k = values(zernike, 3, x, y, z);
  ASSERT_EQ(k.size(), 6u);
  const double r = 1 / std::sqrt(1 + z);  // sqrt(1 - z) (cos, sin)(phi) = (x, y) r
  EXPECT_NEAR(k[0], std::sqrt(1 / (2 * pi)), 1e-15);
  EXPECT_NEAR(k[1], std::sqrt(2 / pi) * y * r, 1e-15);
  EXPECT_NEAR(k[2], std::sqrt(2 / pi) * x * r, 1e-15);
  EXPECT_NEAR(k[3], std::sqrt(3 / pi) * 2 * x * y * r * r, 1e-15);
  EXPECT_NEAR(k[4], std::sqrt(3 / (2 * pi)) * (2 * z - 1), 1e-15);
  EXPECT_NEAR(k[5], std::sqrt(3 / pi) * (x * x - y * y) * r * r, 1e-15);
  const std::vector<double> m0 = values(makhotkin_m0, 2, x, y, z);
  ASSERT_EQ(m0.size(), 4u);
  EXPECT_NEAR(m0[1], k[1], 1e-15);
  EXPECT_NEAR(m0[2], k[4], 1e-15);
  EXPECT_NEAR(m0[3], k[2], 1e-15);
  const std::vector<double> adjoint = values(makhotkin_adjoint, 2, x, y, z);
  EXPECT_NEAR(adjoint[0], std::sqrt(1 / pi) * std::sqrt(z), 1e-15);
  EXPECT_NEAR(adjoint[2], std::sqrt(2 / pi) * std::sqrt(z) * (3 * z - 2), 1e-14);
  EXPECT_NEAR(adjoint[3], std::sqrt(12 / pi) * z * x * r, 1e-15);
  const std::vector<double> even = values(even_sh, 3, x, y, z);
  ASSERT_EQ(even.size(), 6u);
  EXPECT_NEAR(even[1], -std::sqrt(3 / (2 * pi)) * y, 1e-15);
  EXPECT_NEAR(even[4], std::sqrt(5 / (8 * pi)) * (3 * z * z - 1), 1e-15);
}

TEST(HshComparison, AFunctionOfABasisNeedsItsDegreeAlone) {
  const Quadrature q = hemisphere_quadrature(30, 30);
  for (const ComparisonBasis basis : kComparisonBases) {
    if (basis == sh) continue;
    const std::size_t last = static_cast<std::size_t>(comparison_count(basis, 6)) - 1;
    const std::vector<double> a = accuracy_by_order(
        [&](double x, double y, double z) { return values(basis, 6, x, y, z)[last]; }, basis, 8, q);
    for (std::size_t n = 0; n < 5; ++n) EXPECT_NEAR(a[n], 0, 1e-13) << name(basis);
    for (std::size_t n = 5; n < 8; ++n) EXPECT_NEAR(a[n], 1, 1e-13) << name(basis);
  }
}

// Rows: lobes; columns: the bases in the order of kComparisonBases. Figures of an independent program. The
// square of Ward's lobe, not weighted by the cosine, has no integral: it grows with the logarithm of the
// quadrature's least z, here another one.
TEST(HshComparison, AccuracyAt25Coefficients) {
  struct Row {
    const char* lobe;
    DirectionalFunction f;
    double expected[6];
  };
  const double degree = std::numbers::pi / 180;
  const Row rows[] = {
      {"cos^5 about the normal", phong_lobe(5, 0), {1.000, .991, .999, .998, 1.000, 1.000}},
      {"cos^5 at 60 degrees", phong_lobe(5, 60 * degree), {.988, .961, .973, .998, .995, .977}},
      {"Ward 0.2/0.5 from the normal", ward_lobe(.2, .5, 0, 0), {.985, .931, .958, .968, .963, .988}}};
  for (const Row& row : rows) {
    for (std::size_t b = 0; b < 6; ++b) {
      EXPECT_NEAR(accuracy(row.f, kComparisonBases[b]), row.expected[b], 1.5e-3)
          << row.lobe << ", " << name(kComparisonBases[b]);
    }
  }
}

// The same, weighted by the cosine, which is what rendering uses: means over outgoing directions on the
// parabolic map.
TEST(HshComparison, MeanAccuracyOfCosineWeightedLobes) {
  const double expected_phong[6] = {.998, .933, .907, .990, .986, .997},
               expected_ward[6] = {.852, .735, .733, .831, .791, .854};
  for (std::size_t b = 0; b < 6; ++b) {
    const ComparisonBasis basis = kComparisonBases[b];
    EXPECT_NEAR(mean_accuracy(phong_means(true), basis, basis == zernike ? 7 : 5), expected_phong[b], 1e-3)
        << name(basis);
    EXPECT_NEAR(mean_accuracy(ward_means(true), basis, basis == zernike ? 7 : 5), expected_ward[b], 2e-3)
        << name(basis);
  }
}
