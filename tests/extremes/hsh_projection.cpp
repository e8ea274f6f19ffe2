// Projection of what is no light: values and densities that are not finite, zero or negative; nothing at all;
// light of every size.
#include "hsh/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

using namespace phos;

namespace {
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
}  // namespace

TEST(HshProjectionLimits, SamplesThatAreNoneCountAsZero) {
  struct Sample {
    double x, y, z, value, pdf;
  };
  const Sample good{0, 0, 1, 2, 0.5};
  const Sample bad[] = {{0, 0, 1, kNan, 1},      {0, 0, 1, kInfinite, 1}, {0, 0, 1, 1, 0},
                        {0, 0, 1, 0, 0},         {0, 0, 1, 1, -1},        {0, 0, 1, 1, kNan},
                        {0, 0, kNan, 1, 1},      {kInfinite, 0, 1, 1, 1}, {0, -kInfinite, 1, 1, 1},
                        {0, 0, 1, 1e300, 1e-300}};
  std::vector<double> x{good.x}, y{good.y}, z{good.z}, value{good.value}, pdf{good.pdf};
  for (const Sample& s : bad) {
    x.push_back(s.x), y.push_back(s.y), z.push_back(s.z), value.push_back(s.value), pdf.push_back(s.pdf);
  }
  std::size_t rejected = 0;
  const std::vector<double> c = project_samples(BasisKind::hsh, 3, x, y, z, value, pdf, &rejected);
  EXPECT_EQ(rejected, std::size(bad));
  for (int l = 0; l < 3; ++l) {  // at the pole m = 0 alone, sqrt((2l + 1) / (2 pi))
    for (int m = -l; m <= l; ++m) {
      const double expected = m ? 0 : 4. / 11 * std::sqrt((2 * l + 1) / (2 * M_PI));
      EXPECT_NEAR(c[static_cast<std::size_t>(harmonic_index(l, m))], expected, 1e-15);
    }
  }
}

TEST(HshProjectionLimits, NoSamplesAreDark) {
  const std::vector<double> none;
  for (const double c : project_samples(BasisKind::sh, 4, none, none, none, none, none)) EXPECT_EQ(c, 0);
}

TEST(HshProjectionLimits, AFunctionThatIsNotFiniteIsNamed) {
  const Quadrature q = hemisphere_quadrature(4, 4);
  for (const double v : {kNan, kInfinite, -kInfinite}) {
    try {
      project([v](double, double, double) { return v; }, BasisKind::hsh, 3, q);
      ADD_FAILURE() << "accepted " << v;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::numerical);
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
  }
}

TEST(HshProjectionLimits, LightOfEverySize) {
  const Quadrature q = hemisphere_quadrature(12, 12);
  const auto f = [](double x, double, double z) { return 1 + x * z; };
  const std::vector<double> one = project(f, BasisKind::hsh, 5, q);
  for (const double scale : {1e-100, 1e-12, 1e12, 1e100}) {
    const std::vector<double> c =
        project([&](double x, double y, double z) { return scale * f(x, y, z); }, BasisKind::hsh, 5, q);
    for (std::size_t i = 0; i < c.size(); ++i) EXPECT_NEAR(c[i] / scale, one[i], 1e-14);
  }
}

TEST(HshProjectionLimits, NothingIsLeftOutOfNothing) {
  const std::vector<double> dark(9);
  for (const double e : error_by_order(dark, 0)) EXPECT_EQ(e, 0);
}

TEST(HshProjectionLimits, QuadraturesOfOneAndOfManyPoints) {
  for (const int n : {1, 2, 3, 64, 501}) {
    std::vector<double> x, w;
    gauss_legendre(n, x, w);
    double sum = 0, second = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      sum += w[i], second += w[i] * x[i] * x[i];
      EXPECT_GT(w[i], 0);
      EXPECT_LT(std::fabs(x[i]), 1);
      EXPECT_TRUE(i == 0 || x[i] > x[i - 1]);
    }
    EXPECT_NEAR(sum, 2, 1e-12) << n;
    EXPECT_NEAR(second, n == 1 ? 0 : 2. / 3, 1e-12) << n;
  }
  for (const Quadrature& q : {hemisphere_quadrature(1, 1), hemisphere_quadrature(300, 7)}) {
    double sum = 0;
    for (const double w : q.weight) sum += w;
    EXPECT_NEAR(sum, 2 * M_PI, 1e-11);
  }
}
