// Spherical and hemispherical harmonics: closed forms, orthonormality, gradients, the addition theorem.
#include "hsh/basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "hsh/basis_kernel.h"
#include "support/harmonics.h"
#include "support/run.h"

using namespace phos;
using namespace phos::test;

namespace {

constexpr double kPiD = std::numbers::pi;

template <class Real>
std::vector<Real> values(BasisKind kind, int order, Real x, Real y, Real z) {
  const HarmonicBasis<Real> basis(order);
  std::vector<Real> out(static_cast<std::size_t>(basis.count()));
  basis.evaluate(kind, x, y, z, out.data());
  return out;
}

void expect_below(const std::vector<double>& deviation, std::size_t bands, double limit, const char* what) {
  ASSERT_EQ(deviation.size(), bands) << what;
  for (std::size_t l = 0; l < bands; ++l) EXPECT_LT(deviation[l], limit) << what << ", band " << l;
}

template <class Real>
void expect_batch_is_scalar(const std::vector<Real>& x, const std::vector<Real>& y,
                            const std::vector<Real>& z) {
  const std::size_t n = x.size();
  for (const BasisKind kind : {BasisKind::sh, BasisKind::hsh}) {
    for (const int order : {1, 2, 10, 31}) {
      const HarmonicBasis<Real> basis(order);
      const std::size_t count = static_cast<std::size_t>(basis.count());
      std::vector<Real> v(count), gx(v), gy(v), gz(v), batch(count * n), with(batch), bx(batch), by(batch),
          bz(batch);
      basis.evaluate_batch(kind, n, x.data(), y.data(), z.data(), batch.data());
      basis.evaluate_batch(kind, n, x.data(), y.data(), z.data(), with.data(), bx.data(), by.data(),
                           bz.data());
      EXPECT_EQ(batch, with);
      for (std::size_t k = 0; k < n; ++k) {
        EXPECT_EQ(values(kind, order, x[k], y[k], z[k])[count - 1], batch[(count - 1) * n + k]);
        basis.evaluate(kind, x[k], y[k], z[k], v.data(), gx.data(), gy.data(), gz.data());
        for (std::size_t i = 0; i < count; ++i) {
          ASSERT_EQ(batch[i * n + k], v[i]) << i << " " << k;
          ASSERT_EQ(bx[i * n + k], gx[i]) << i << " " << k;
          ASSERT_EQ(by[i * n + k], gy[i]) << i << " " << k;
          ASSERT_EQ(bz[i * n + k], gz[i]) << i << " " << k;
        }
      }
      basis.evaluate_batch(kind, n, x.data(), y.data(), z.data(), with.data(), bx.data(), bz.data(), nullptr);
      EXPECT_EQ(bz, by);
    }
  }
}

#ifdef PHOS_HSH_AVX2
template <class Real>
void expect_kernels_agree(const std::vector<Real>& x, const std::vector<Real>& y,
                          const std::vector<Real>& z) {
  const int order = 20;
  const std::size_t n = x.size();
  const std::vector<Real> none(static_cast<std::size_t>(harmonic_count(order)) * n);
  for (const BasisKind kind : {BasisKind::sh, BasisKind::hsh}) {
    std::vector<Real> plain[4] = {none, none, none, none}, newer[4] = {none, none, none, none};
    const auto& t = basis_tables<Real>();
    evaluate_batch_plain(t, kind, order, n, x.data(), y.data(), z.data(), plain[0].data());
    evaluate_batch_avx2(t, kind, order, n, x.data(), y.data(), z.data(), newer[0].data());
    EXPECT_EQ(plain[0], newer[0]);
    EXPECT_NE(plain[0], none);
    evaluate_gradients_plain(t, kind, order, n, x.data(), y.data(), z.data(), plain[0].data(),
                             plain[1].data(), plain[2].data(), plain[3].data());
    evaluate_gradients_avx2(t, kind, order, n, x.data(), y.data(), z.data(), newer[0].data(), newer[1].data(),
                            newer[2].data(), newer[3].data());
    for (int i = 0; i < 4; ++i) EXPECT_EQ(plain[i], newer[i]) << i;
  }
}
#endif

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

TEST(HshBasis, AgreesWithTheGoldenTables) {
  for (const BasisKind kind : {BasisKind::sh, BasisKind::hsh}) {
    expect_below(golden_value_deviation<double>(data("golden/hsh"), kind), 20, 1e-12, "value");
    expect_below(golden_value_deviation<float>(data("golden/hsh"), kind), 20, 5e-5, "value, float");
    expect_below(golden_gradient_deviation<double>(data("golden/hsh"), kind), 10, 1e-12, "gradient");
    expect_below(golden_gradient_deviation<float>(data("golden/hsh"), kind), 10, 5e-5, "gradient, float");
  }
}

TEST(HshBasis, AgreesWithTheWholeGoldenTables) {
  const std::string folder = shared("golden/hsh");
  if (folder.empty()) GTEST_SKIP() << "../shared/golden/hsh is not there";
  for (const BasisKind kind : {BasisKind::sh, BasisKind::hsh}) {
    expect_below(golden_value_deviation<double>(folder, kind), 20, 1e-12, "value");
    expect_below(golden_value_deviation<float>(folder, kind), 20, 5e-5, "value, float");
    expect_below(golden_gradient_deviation<double>(folder, kind), 10, 1e-12, "gradient");
    expect_below(golden_gradient_deviation<float>(folder, kind), 10, 5e-5, "gradient, float");
  }
}

TEST(HshBasis, IsOrthonormal) {
  EXPECT_LT(gram_residual<double>(BasisKind::sh, 30, sphere_quadrature(30, 60)).back(), 1e-13);
  EXPECT_LT(gram_residual<double>(BasisKind::hsh, 30, hemisphere_quadrature(61, 60)).back(), 1e-13);
  EXPECT_LT(gram_residual<float>(BasisKind::sh, 30, sphere_quadrature(30, 60)).back(), 3e-6);
  EXPECT_LT(gram_residual<float>(BasisKind::hsh, 30, hemisphere_quadrature(61, 60)).back(), 3e-6);
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
  expect_batch_is_scalar(q.x, q.y, q.z);
  expect_batch_is_scalar(std::vector<float>(q.x.begin(), q.x.end()),
                         std::vector<float>(q.y.begin(), q.y.end()),
                         std::vector<float>(q.z.begin(), q.z.end()));
}

TEST(HshBasis, EveryMachineGetsTheSameBits) {
#ifdef PHOS_HSH_AVX2
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) GTEST_SKIP() << "no AVX2 here";
  const Quadrature q = sphere_quadrature(9, 17);
  expect_kernels_agree(q.x, q.y, q.z);
  expect_kernels_agree(std::vector<float>(q.x.begin(), q.x.end()), std::vector<float>(q.y.begin(), q.y.end()),
                       std::vector<float>(q.z.begin(), q.z.end()));
#else
  GTEST_SKIP() << "one kernel alone is built for this machine";
#endif
}
