// Spherical and hemispherical harmonics: closed forms, orthonormality, gradients, the addition theorem.
#include "hsh/basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "hsh/quadrature.h"

using namespace phos;

namespace {

constexpr double kPiD = std::numbers::pi;

template <class Real>
std::vector<Real> values(BasisKind kind, int order, Real x, Real y, Real z) {
  const HarmonicBasis<Real> basis(order);
  std::vector<Real> out(static_cast<std::size_t>(basis.count()));
  basis.evaluate(kind, x, y, z, out.data());
  return out;
}

/// Largest entry of |B^T W B - I|: how far the basis is from orthonormal.
template <class Real>
double gram_residual(BasisKind kind, int order, const Quadrature& q) {
  const HarmonicBasis<Real> basis(order);
  const std::size_t n = static_cast<std::size_t>(basis.count());
  std::vector<double> gram(n * n);
  std::vector<Real> out(n);
  for (std::size_t k = 0; k < q.size(); ++k) {
    basis.evaluate(kind, static_cast<Real>(q.x[k]), static_cast<Real>(q.y[k]), static_cast<Real>(q.z[k]),
                   out.data());
    for (std::size_t i = 0; i < n; ++i) {
      const double weighted = q.weight[k] * static_cast<double>(out[i]);
      for (std::size_t j = 0; j <= i; ++j) gram[i * n + j] += weighted * static_cast<double>(out[j]);
    }
  }
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) worst = std::max(worst, std::fabs(gram[i * n + j] - (i == j)));
  }
  return worst;
}

}  // namespace

TEST(HshBasis, LowOrdersAreTheClosedForms) {
  const double x = 0.48, y = -0.36, z = 0.8;
  const std::vector<double> y3 = values(BasisKind::sh, 3, x, y, z);
  const double expected[] = {std::sqrt(1 / (4 * kPiD)),
                             -std::sqrt(3 / (4 * kPiD)) * y,
                             std::sqrt(3 / (4 * kPiD)) * z,
                             -std::sqrt(3 / (4 * kPiD)) * x,
                             std::sqrt(15 / (4 * kPiD)) * x * y,
                             -std::sqrt(15 / (4 * kPiD)) * y * z,
                             std::sqrt(5 / (16 * kPiD)) * (3 * z * z - 1),
                             -std::sqrt(15 / (4 * kPiD)) * x * z,
                             std::sqrt(15 / (16 * kPiD)) * (x * x - y * y)};
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(y3[i], expected[i], 1e-15) << i;
  const std::vector<double> h2 = values(BasisKind::hsh, 2, x, y, z);
  const double h = std::sqrt(z / (1 + z));
  EXPECT_NEAR(h2[0], std::sqrt(1 / (2 * kPiD)), 1e-15);
  EXPECT_NEAR(h2[1], -std::sqrt(3 / (2 * kPiD)) * 2 * h * y, 1e-15);
  EXPECT_NEAR(h2[2], std::sqrt(3 / (2 * kPiD)) * (2 * z - 1), 1e-15);
  EXPECT_NEAR(h2[3], -std::sqrt(3 / (2 * kPiD)) * 2 * h * x, 1e-15);
}

TEST(HshBasis, IsOrthonormal) {
  EXPECT_LT(gram_residual<double>(BasisKind::sh, 30, sphere_quadrature(30, 60)), 2e-13);
  EXPECT_LT(gram_residual<double>(BasisKind::hsh, 30, hemisphere_quadrature(61, 60)), 2e-13);
  EXPECT_LT(gram_residual<float>(BasisKind::sh, 30, sphere_quadrature(30, 60)), 3e-6);
  EXPECT_LT(gram_residual<float>(BasisKind::hsh, 30, hemisphere_quadrature(61, 60)), 3e-6);
}

TEST(HshBasis, SquaresOfABasisAddUpToAConstant) {
  for (const double z : {0., 1e-9, 0.3, 0.7, 1.}) {
    const double r = std::sqrt(1 - z * z), x = r * std::cos(0.7), y = r * std::sin(0.7);
    for (const int order : {1, 5, 30, 100}) {
      double sh = 0, hsh = 0;
      for (const double v : values(BasisKind::sh, order, x, y, z)) sh += v * v;
      for (const double v : values(BasisKind::hsh, order, x, y, z)) hsh += v * v;
      EXPECT_NEAR(sh / (order * order / (4 * kPiD)), 1, 1e-11) << z << " " << order;
      EXPECT_NEAR(hsh / (order * order / (2 * kPiD)), 1, 1e-11) << z << " " << order;
    }
  }
}

TEST(HshBasis, GradientIsTheDerivativeAlongTheSphere) {
  const int order = 12;
  const HarmonicBasis<double> basis(order);
  const std::size_t n = static_cast<std::size_t>(basis.count());
  std::vector<double> v(n), gx(n), gy(n), gz(n), plus(n), minus(n);
  for (const BasisKind kind : {BasisKind::sh, BasisKind::hsh}) {
    for (const double theta : {0., 0.3, 0.9, 1.4}) {
      const double phi = 0.7;
      const double w[3] = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
      // Two tangents, valid at the pole too.
      const double tangent[2][3] = {
          {std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -std::sin(theta)},
          {-std::sin(phi), std::cos(phi), 0}};
      basis.evaluate(kind, w[0], w[1], w[2], v.data(), gx.data(), gy.data(), gz.data());
      EXPECT_EQ(v, values(kind, order, w[0], w[1], w[2]));
      for (const auto& t : tangent) {
        const double step = 1e-5, c = std::cos(step), s = std::sin(step);
        basis.evaluate(kind, c * w[0] + s * t[0], c * w[1] + s * t[1], c * w[2] + s * t[2], plus.data());
        basis.evaluate(kind, c * w[0] - s * t[0], c * w[1] - s * t[1], c * w[2] - s * t[2], minus.data());
        for (std::size_t i = 0; i < n; ++i) {
          EXPECT_NEAR(gx[i] * t[0] + gy[i] * t[1] + gz[i] * t[2], (plus[i] - minus[i]) / (2 * step), 1e-5)
              << "function " << i << " theta " << theta;
          EXPECT_NEAR(gx[i] * w[0] + gy[i] * w[1] + gz[i] * w[2], 0, 1e-11);
        }
      }
    }
  }
}

TEST(HshBasis, BatchAndScalarGiveTheSameBits) {
  const Quadrature q = hemisphere_quadrature(7, 11);  // 77: no multiple of any vector's width
  for (const BasisKind kind : {BasisKind::sh, BasisKind::hsh}) {
    for (const int order : {1, 2, 10, 31}) {
      const HarmonicBasis<double> basis(order);
      const std::size_t count = static_cast<std::size_t>(basis.count());
      std::vector<double> batch(count * q.size());
      basis.evaluate_batch(kind, q.size(), q.x.data(), q.y.data(), q.z.data(), batch.data());
      for (std::size_t k = 0; k < q.size(); ++k) {
        const std::vector<double> one = values(kind, order, q.x[k], q.y[k], q.z[k]);
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(batch[i * q.size() + k], one[i]) << i << " " << k;
      }
    }
  }
}
