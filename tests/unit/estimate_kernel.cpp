// The classical kernel estimates, alone and as records.
#include <gtest/gtest.h>

#include "core/random.h"
#include "core/sampling.h"
#include "support/records.h"

namespace phos {
namespace {

constexpr Kernel kKernels[] = {Kernel::disc, Kernel::epanechnikov, Kernel::cone};

ZoneEstimate estimate(const std::vector<Vec2>& points, Kernel kernel, float radius = 1) {
  DensityScratch scratch;
  return kernel_irradiance(points, std::vector<Rgb>(points.size(), Rgb(1)), radius, kernel, scratch);
}

std::vector<Vec2> disc(std::size_t n, std::uint64_t item) {
  RandomStream random(21, Stage::test, item);
  std::vector<Vec2> points(n);
  for (Vec2& p : points) p = sample_disc(random.uniform2());
  return points;
}

TEST(Kernel, WeightsHaveMeanOneOverTheDisc) {
  for (const Kernel kernel : kKernels) {
    double sum = 0;
    const int n = 100000;  // rings of equal area
    for (int i = 0; i < n; ++i) sum += kernel_weight(kernel, std::sqrt((i + 0.5) / n));
    EXPECT_NEAR(sum / n, 1, 1e-5);
    EXPECT_EQ(kernel_weight(kernel, 1), kernel == Kernel::disc ? 1 : 0);
  }
}

TEST(Kernel, OnePhotonCountsByItsPlace) {
  for (const Kernel kernel : kKernels) {
    const ZoneEstimate e = estimate({{1, 0}}, kernel, 2);  // half way out
    const double expected = kernel == Kernel::disc ? 1 : 1.5;
    EXPECT_NEAR(e.irradiance.x, expected / (4 * std::numbers::pi), 1e-7);
    EXPECT_NEAR(e.stderr_lx.x, e.irradiance.x, 1e-7) << "one photon: as uncertain as it is large";
    EXPECT_EQ(e.kind, ZoneKind::kernel);
    EXPECT_FALSE(e.partial);
  }
}

TEST(Kernel, NoPhotonIsNoLight) {
  for (const Kernel kernel : kKernels) {
    EXPECT_EQ(estimate({}, kernel).irradiance, Rgb(0));
    EXPECT_EQ(estimate({}, kernel).stderr_lx, Rgb(0));
    EXPECT_NEAR(estimate({}, kernel).area_m2, std::numbers::pi, 1e-12);
  }
}

/// n var = 1 : 4/3 : 3/2 (docs/methods.md#c4), in the stated error too.
TEST(Kernel, VarianceIsThatOfTheClosedForm) {
  const int n = 400, zones = 2000;
  const double expected[] = {1, 4.0 / 3, 1.5};
  for (std::size_t k = 0; k < 3; ++k) {
    double stated = 0, squares = 0;
    for (int r = 0; r < zones; ++r) {
      const ZoneEstimate e = estimate(disc(n, static_cast<std::uint64_t>(r)), kKernels[k]);
      const double scale = std::numbers::pi / n, x = static_cast<double>(e.irradiance.x) * scale - 1;
      squares += x * x, stated += std::pow(static_cast<double>(e.stderr_lx.x) * scale, 2);
    }
    EXPECT_NEAR(stated / zones * n, expected[k], 0.02);
    // n is fixed here: the binomial part of a Poisson process, 1, is missing.
    EXPECT_NEAR(squares / zones * n, expected[k] - 1, 0.06);
  }
}

/// E = 1 + x2 + y2 over a disc of radius 1: kernels see +1/2, +1/3, +3/10 of it (docs/methods.md#c4).
TEST(Kernel, CurvatureBiasIsThatOfTheClosedForm) {
  const double expected[] = {0.5, 1.0 / 3, 0.3};
  std::vector<Vec2> points;
  std::vector<Rgb> flux;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const float r = std::sqrt((static_cast<float>(i) + 0.5f) / n), t = 2.3999632f * static_cast<float>(i);
    points.push_back({r * std::cos(t), r * std::sin(t)});
    flux.push_back(Rgb((1 + r * r) * kPi / n));
  }
  DensityScratch scratch;
  for (std::size_t k = 0; k < 3; ++k) {
    const ZoneEstimate e = kernel_irradiance(points, flux, 1, kKernels[k], scratch);
    EXPECT_NEAR(e.irradiance.x, 1 + expected[k], 1e-3);
  }
}

/// A disc that ends at the k-th of many photons, without it: (k-1)/(pi r_k2) has no bias for any kernel,
/// k/(pi r_k2) is high by 1/(k-1).
TEST(Kernel, TheKthPhotonDecidesTheDiscAndDoesNotCount) {
  const std::size_t k = 10;
  for (const Kernel kernel : kKernels) {
    double sum = 0, squares = 0;
    const int zones = 4000, n = 200;
    for (int r = 0; r < zones; ++r) {
      std::vector<Vec2> points = disc(n, static_cast<std::uint64_t>(10000 + r));
      std::sort(points.begin(), points.end(),
                [](const Vec2& a, const Vec2& b) { return glm::dot(a, a) < glm::dot(b, b); });
      const float radius = glm::length(points[k - 1]);
      points.resize(k - 1);
      // n photons on the unit disc; n fixed makes 1/r2 a little low: E[(k-1)/r_k2] = n exactly.
      const double x =
          static_cast<double>(estimate(points, kernel, radius).irradiance.x) * std::numbers::pi / n;
      sum += x, squares += x * x;
    }
    const double mean = sum / zones, error = std::sqrt((squares / zones - mean * mean) / zones);
    EXPECT_NEAR(mean, 1, 4 * error);
    EXPECT_LT(error, 0.01);
  }
}

/// What rays ask of places without a record is what a record would say there, dark or lit, and at a border.
TEST(DensityEstimator, LightAloneIsThatOfTheRecord) {
  const test::AnalyticScene s = test::emitting_environment();
  const Vec3 u(1, 0.25f, 0), v = glm::cross(glm::normalize(Vec3(-0.25f, 1, 0.5f)), glm::normalize(u));
  const Vec3 n = glm::normalize(glm::cross(v, u));
  for (const Estimate estimate : {Estimate::hull, Estimate::kernel}) {
    RecordOptions options = test::all_light(s.scene);
    options.estimate = estimate;
    options.max_radius_m = 0.02;  // so that some zones have no photon
    int lit_places = 0, dark = 0;
    for (const std::int64_t paths : {300, 100000}) {
      const test::Lit lit = test::light_up(s.scene, paths);
      const DensityEstimator maker(lit.photons, *lit.rays, options, 1);
      const auto worker = maker.make_worker();
      for (int i = 0; i < 50; ++i) {
        const RecordSite at{0.01f * static_cast<float>(i) * u, n, static_cast<std::uint64_t>(i)};
        const Rgb expected = maker.make(at, *worker).record.irradiance;
        EXPECT_EQ(maker.irradiance_lx(at, *worker), expected);
        expected.y > 0 ? ++lit_places : ++dark;
      }
    }
    EXPECT_GT(lit_places, 10);
    EXPECT_GT(dark, 10);
  }
}

/// Records: right well inside of a surface, half at its border, and of the hull's zone and gradients.
TEST(KernelRecord, InsideRightAtTheBorderHalf) {
  const test::AnalyticScene s = test::emitting_environment();
  const test::Lit lit = test::light_up(s.scene, 1000000);
  const Vec3 u(1, 0.25f, 0), v = glm::cross(glm::normalize(Vec3(-0.25f, 1, 0.5f)), glm::normalize(u));
  const Vec3 n = glm::normalize(glm::cross(v, u));
  const double truth = 100 * std::numbers::pi;
  RecordOptions options = test::all_light(s.scene);
  const IrradianceRecord hull =
      test::record_at(DensityEstimator(lit.photons, *lit.rays, options, 1), Vec3(0), n);
  options.estimate = Estimate::kernel;
  for (const Kernel kernel : kKernels) {
    options.kernel = kernel;
    const DensityEstimator maker(lit.photons, *lit.rays, options, 1);
    const IrradianceRecord inside = test::record_at(maker, Vec3(0), n);
    EXPECT_NEAR(inside.irradiance.y, truth, 4 * static_cast<double>(inside.stderr_lx.y));
    EXPECT_EQ(inside.distance_m, hull.distance_m);
    EXPECT_EQ(inside.radius_m, hull.radius_m);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(glm::length(inside.translation_gradient[c] - hull.translation_gradient[c]), 0,
                  1e-3 * truth);
    }
    const IrradianceRecord border = test::record_at(maker, 0.5f * u, n);
    EXPECT_NEAR(border.irradiance.y, truth / 2, 4 * static_cast<double>(border.stderr_lx.y));
  }
}

}  // namespace
}  // namespace phos
