// Coefficients of functions: golden tables, closed forms, what orders leave out, windows.
#include "hsh/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "support/golden_table.h"
#include "support/run.h"

using namespace phos;
using namespace phos::test;

namespace {

constexpr double kPiD = std::numbers::pi;
constexpr double kDegree = kPiD / 180;

/// The cap of `half_angle` about the direction (theta, phi), exact for harmonics to order 12.
Quadrature cap(double half_angle, double theta, double phi) {
  std::vector<double> t, w;
  gauss_legendre(40, t, w);
  const int sectors = 80;
  const double low = std::cos(half_angle);
  Quadrature q;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double c = low + (1 - low) * (1 + t[i]) / 2, s = std::sqrt((1 - c) * (1 + c));
    for (int k = 0; k < sectors; ++k) {
      const double a = 2 * kPiD * k / sectors, u = s * std::cos(a), v = s * std::sin(a);
      const double along = std::cos(theta) * u + std::sin(theta) * c;  // turned about y, then about z
      q.x.push_back(std::cos(phi) * along - std::sin(phi) * v);
      q.y.push_back(std::sin(phi) * along + std::cos(phi) * v);
      q.z.push_back(std::cos(theta) * c - std::sin(theta) * u);
      q.weight.push_back((1 - low) / 2 * w[i] * 2 * kPiD / sectors);
    }
  }
  return q;
}

double one(double, double, double) { return 1; }

double norm2(const DirectionalFunction& f, const Quadrature& q) {
  double sum = 0;
  for (std::size_t k = 0; k < q.size(); ++k) {
    const double v = f(q.x[k], q.y[k], q.z[k]);
    sum += v * v * q.weight[k];
  }
  return sum;
}

double phong(double exponent, double theta, double x, double z) {
  return std::pow(std::max(0., std::sin(theta) * x + std::cos(theta) * z), exponent);
}

}  // namespace

TEST(HshProjection, ZonalFunctionsAgreeWithTheGoldenTable) {
  const Quadrature q = hemisphere_quadrature(40, 24);
  std::map<std::string, std::vector<double>> got;  // "function,basis"
  for (const BasisKind kind : {BasisKind::sh, BasisKind::hsh}) {
    const std::string basis = kind == BasisKind::sh ? ",sh" : ",hsh";
    const auto power = [&](int n) {
      return project([n](double, double, double z) { return std::pow(z, n); }, kind, 10, q);
    };
    got["constant1" + basis] = power(0);
    got["costheta" + basis] = power(1);
    got["cos5" + basis] = power(5);
    got["cos20" + basis] = power(20);
    got["cap30deg" + basis] = project(one, kind, 10, cap(30 * kDegree, 0, 0));
    got["cap60deg" + basis] = project(one, kind, 10, cap(60 * kDegree, 0, 0));
  }
  const auto rows = read_table(data("golden/hsh/projection_zonal_order10.csv"));
  ASSERT_EQ(rows.size(), 120u);
  for (const auto& row : rows) {
    const std::vector<double>& c = got.at(row.at("function") + "," + row.at("basis"));
    const int l = std::stoi(row.at("l"));
    EXPECT_NEAR(c[static_cast<std::size_t>(harmonic_index(l, 0))], std::stod(row.at("coef")), 1e-13)
        << row.at("function") << row.at("basis") << l;
    for (int m = 1; m <= l; ++m) {
      EXPECT_NEAR(c[static_cast<std::size_t>(harmonic_index(l, m))], 0, 1e-13);
      EXPECT_NEAR(c[static_cast<std::size_t>(harmonic_index(l, -m))], 0, 1e-13);
    }
  }
}

TEST(HshProjection, TiltedCapAgreesWithTheGoldenTable) {
  const Quadrature q = cap(20 * kDegree, 40 * kDegree, 30 * kDegree);
  const std::vector<double> sh = project(one, BasisKind::sh, 10, q),
                            hsh = project(one, BasisKind::hsh, 10, q);
  const auto rows = read_table(data("golden/hsh/tilted_cap_order10.csv"));
  ASSERT_EQ(rows.size(), 200u);
  for (const auto& row : rows) {
    const int i = harmonic_index(std::stoi(row.at("l")), std::stoi(row.at("m")));
    EXPECT_NEAR((row.at("basis") == "sh" ? sh : hsh)[static_cast<std::size_t>(i)], std::stod(row.at("coef")),
                1e-13)
        << row.at("basis") << i;
  }
}

TEST(HshProjection, AFunctionOfTheBasisHasOneCoefficient) {
  const int order = 24;
  const HarmonicBasis<double> basis(order);
  const std::size_t n = static_cast<std::size_t>(basis.count());
  std::vector<double> values(n);
  for (const BasisKind kind : {BasisKind::sh, BasisKind::hsh}) {
    const Quadrature q = kind == BasisKind::sh ? sphere_quadrature(order, 2 * order)
                                               : hemisphere_quadrature(2 * order, 2 * order);
    for (const std::size_t j : {0u, 1u, 3u, 130u, 540u, 575u}) {
      const std::vector<double> c = project(
          [&](double x, double y, double z) {
            basis.evaluate(kind, x, y, z, values.data());
            return values[j];
          },
          kind, order, q);
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(c[i], i == j ? 1 : 0, 1e-13) << i << " " << j;
    }
  }
}

TEST(HshProjection, ABandLimitedFunctionComesBack) {
  std::vector<double> c(49);
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = std::sin(static_cast<double>(i) + 0.5);
  for (const BasisKind kind : {BasisKind::sh, BasisKind::hsh}) {
    const Quadrature q = kind == BasisKind::sh ? sphere_quadrature(8, 16) : hemisphere_quadrature(16, 16);
    const auto f = [&](double x, double y, double z) { return reconstruct(c, kind, x, y, z); };
    const std::vector<double> again = project(f, kind, 7, q);
    for (std::size_t i = 0; i < c.size(); ++i) EXPECT_NEAR(again[i], c[i], 1e-13);
    double sum = 0;
    for (const double e : energy_by_band(c)) sum += e;
    EXPECT_NEAR(sum, norm2(f, q), 1e-11);
  }
}

// The cosine has two coefficients, so the irradiance of any incoming light needs no more.
TEST(HshProjection, TwoCoefficientsGiveTheIrradiance) {
  const Quadrature q = hemisphere_quadrature(40, 60);
  const auto light = [](double x, double y, double z) { return 3 + x * y + std::exp(-2 * z) + x * x * x; };
  double expected = 0;
  for (std::size_t k = 0; k < q.size(); ++k) expected += q.weight[k] * q.z[k] * light(q.x[k], q.y[k], q.z[k]);
  const std::vector<double> c = project(light, BasisKind::hsh, 2, q);
  EXPECT_NEAR(std::sqrt(kPiD / 2) * c[0] + std::sqrt(kPiD / 6) * c[2], expected, 1e-13 * expected);
}

// Figures of an independent program: what is left out of 1 + sin(theta) cos(phi), which HSH cannot follow
// along the horizon, and of the constant hemisphere, whose edge SH smear.
TEST(HshProjection, ErrorByOrder) {
  const Quadrature q = hemisphere_quadrature(64, 64);
  const auto tilted = [](double x, double, double) { return 1 + x; };
  const std::vector<double> hsh = error_by_order(project(tilted, BasisKind::hsh, 10, q), norm2(tilted, q));
  const std::vector<double> sh = error_by_order(project(tilted, BasisKind::sh, 10, q), norm2(tilted, q));
  ASSERT_EQ(hsh.size(), 10u);
  EXPECT_NEAR(hsh[2], 1e-2, 5e-4);
  EXPECT_NEAR(hsh[4], 3.8e-3, 5e-5);
  EXPECT_NEAR(hsh[9], 9.4e-4, 5e-6);
  EXPECT_NEAR(sh[2], 0.13, 5e-3);
  EXPECT_NEAR(sh[4], 0.075, 5e-4);
  EXPECT_NEAR(sh[9], 0.035, 5e-4);
  for (std::size_t n = 1; n < 10; ++n) EXPECT_LE(hsh[n], hsh[n - 1]);
  const std::vector<double> flat = error_by_order(project(one, BasisKind::sh, 20, q), 2 * kPiD);
  EXPECT_NEAR(flat[4], 0.070, 5e-4);
  EXPECT_NEAR(flat[9], 0.030, 5e-3);
  EXPECT_NEAR(flat[19], 0.016, 5e-4);
  EXPECT_LT(error_by_order(project(one, BasisKind::hsh, 1, q), 2 * kPiD)[0], 1e-14);
}

// A cap of 15 degrees at 40 degrees, order 10: extremes of the reconstruction, and the error of the light
// that a cosine-weighted lobe (exponent 15) reflects; figures of an independent program.
TEST(HshProjection, WindowsTradeRingingForError) {
  const Quadrature q = hemisphere_quadrature(56, 112), light = cap(15 * kDegree, 40 * kDegree, 0);
  const auto lobe = [](double x, double, double z) { return z * phong(15, 30 * kDegree, x, z); };
  const std::vector<double> brdf = project(lobe, BasisKind::hsh, 10, q);
  double truth = 0;
  for (std::size_t k = 0; k < light.size(); ++k) {
    truth += light.weight[k] * lobe(light.x[k], light.y[k], light.z[k]);
  }
  struct Expected {
    Window window;
    double least, most, error;
  };
  for (const Expected& e : {Expected{Window::none, -0.054, 1.38, 1e-4},
                            {Window::lanczos, -0.010, 0.91, 0.10},
                            {Window::hann, -0.008, 0.77, 0.15}}) {
    std::vector<double> c = project(one, BasisKind::hsh, 10, light);
    apply_window(e.window, c);
    double least = 0, most = 0, reflected = 0;
    for (std::size_t k = 0; k < q.size(); ++k) {
      const double v = reconstruct(c, BasisKind::hsh, q.x[k], q.y[k], q.z[k]);
      least = std::min(least, v);
      most = std::max(most, v);
    }
    for (std::size_t i = 0; i < c.size(); ++i) reflected += c[i] * brdf[i];
    EXPECT_NEAR(least, e.least, 2e-3);
    EXPECT_NEAR(most, e.most, 2e-2);
    EXPECT_NEAR(std::fabs(reflected / truth - 1), e.error, std::max(5e-5, 0.05 * e.error));
  }
}

TEST(HshProjection, SamplesOfAStratifiedGridConvergeOnTheIntegral) {
  const auto f = [](double x, double y, double z) { return 1 + x * z + y * y; };
  const std::vector<double> exact = project(f, BasisKind::hsh, 6, hemisphere_quadrature(40, 40));
  std::vector<double> x, y, z, value, pdf;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 200; ++j) {
      const double up = (i + 0.5) / 200, phi = 2 * kPiD * (j + 0.5) / 200, r = std::sqrt(1 - up * up);
      x.push_back(r * std::cos(phi)), y.push_back(r * std::sin(phi)), z.push_back(up);
      value.push_back(f(x.back(), y.back(), up));
      pdf.push_back(1 / (2 * kPiD));
    }
  }
  std::size_t rejected = 7;
  const std::vector<double> c = project_samples(BasisKind::hsh, 6, x, y, z, value, pdf, &rejected);
  EXPECT_EQ(rejected, 0u);
  for (std::size_t i = 0; i < c.size(); ++i) EXPECT_NEAR(c[i], exact[i], 1e-3) << i;
}
