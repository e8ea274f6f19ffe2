// Boundary bias before and after: records by the classical kernels and by the hull near the border of a
// surface and near the edge of a shadow, against the closed form. All zones have one radius, and are apart
// from each other, so that their errors are independent.
#include <gtest/gtest.h>

#include "support/records.h"
#include "support/zone_borders.h"

namespace phos {
namespace {

constexpr float kZone_m = 0.1f;
constexpr double kSigmas = 3.7;  // 0.02 % each, for some fifty comparisons

/// Zones of kZone_m, however many photons they hold.
RecordOptions fixed_zones(const Scene& scene) {
  RecordOptions options;
  options.paths = Quantity::all;
  options.accuracy = 0.2, options.max_radius_m = static_cast<double>(kZone_m) / options.accuracy;
  options.min_radius_m = *options.max_radius_m / 10;
  options.min_photons = 1, options.max_photons = 10'000'000;
  options.resolve(scene.bounds.diagonal_m() / 4);
  return options;
}

struct Errors {
  double bias = 0, error = 0, rmse = 0;  ///< relative; of the mean
};

/// Relative to `scale_lx` of each place.
Errors errors_at(const Estimator& estimator, const std::vector<test::Check>& places, double scale_lx) {
  double sum = 0, squares = 0;
  std::uint64_t item = 0;
  for (const test::Check& place : places) {
    const IrradianceRecord r = test::record_at(estimator, place.position, place.normal, item++);
    const double error = (static_cast<double>(r.irradiance.y) - place.irradiance_lx) / scale_lx;
    sum += error, squares += error * error;
  }
  const auto n = static_cast<double>(places.size());
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1)), std::sqrt(squares / n)};
}

struct Estimators {
  Estimators(const test::Lit& lit, RecordOptions options) : hull(lit.photons, *lit.rays, options, 1) {
    options.estimate = Estimate::kernel;
    for (const Kernel kernel : {Kernel::disc, Kernel::epanechnikov, Kernel::cone}) {
      options.kernel = kernel;
      kernels.emplace_back(kernel, std::make_unique<DensityEstimator>(lit.photons, *lit.rays, options, 1));
    }
  }
  DensityEstimator hull;
  std::vector<std::pair<Kernel, std::unique_ptr<DensityEstimator>>> kernels;
};

/// A square sheet of a metre in light that is the same from everywhere: 32 zones beside its four edges, on
/// both sides.
TEST(Borders, SheetInAUniformEnvironment) {
  const test::AnalyticScene s = test::emitting_environment();
  const test::Lit lit = test::light_up(s.scene, 1'500'000);
  const Estimators by(lit, fixed_zones(s.scene));
  const Vec3 u(1, 0.25f, 0), v = glm::cross(glm::normalize(Vec3(-0.25f, 1, 0.5f)), glm::normalize(u));
  const Vec3 n = glm::normalize(glm::cross(v, u));
  const double truth = 100 * std::numbers::pi;
  for (const float distance : {1.f, 0.5f, 0.25f, 0.1f, 0.f}) {
    std::vector<test::Check> places;
    for (const float along : {-0.33f, -0.11f, 0.11f, 0.33f}) {
      for (const float edge : {-1.f, 1.f}) {
        for (const float side : {-1.f, 1.f}) {
          const float across = 0.5f - distance * kZone_m / glm::length(u);
          places.push_back({edge * across * u + along * v, side * n, truth});
          places.push_back({along * u + edge * (0.5f - distance * kZone_m) * v, side * n, truth});
        }
      }
    }
    const Errors hull = errors_at(by.hull, places, truth);
    EXPECT_NEAR(hull.bias, 0, kSigmas * hull.error + 0.01) << distance;
    for (const auto& [kernel, maker] : by.kernels) {
      const Errors e = errors_at(*maker, places, truth);
      const double share = test::kernel_share(kernel, static_cast<double>(distance));
      EXPECT_NEAR(e.bias, share - 1, kSigmas * e.error + 0.005)
          << distance << " " << static_cast<int>(kernel);
      if (distance < 0.5f) {
        EXPECT_LT(2 * hull.rmse, e.rmse) << distance;
      }
    }
  }
}

/// A lamp over a floor, half of which lies in the shadow of a plate: its edge is sharp and straight, at x =
/// 0.
TEST(Borders, EdgeOfAShadow) {
  Scene scene;
  const float h = 2;
  test::begin_instance(scene, "floor", test::add_lambert(scene, "black", 0));
  test::add_quad(scene, {-8, 0, -8}, {0, 0, 16}, {16, 0, 0});
  test::begin_instance(scene, "plate", 0);
  test::add_quad(scene, {-8, 1, -8}, {0, 0, 16}, {8, 0, 0});
  test::add_point_light(scene, {0, h, 0}, 1000);
  finalize(scene);
  const test::Lit lit = test::light_up(scene, 1'500'000);
  const Estimators by(lit, fixed_zones(scene));
  for (const float distance : {1.f, 0.5f, 0.25f, 0.1f, -0.25f, -0.5f}) {
    std::vector<test::Check> places;
    double mean_lx = 0;
    for (int i = -6; i <= 6; ++i) {
      const Vec3 p(distance * kZone_m, 0, 0.21f * static_cast<float>(i));
      const double lx = test::point_over_plane_lx(1000, h, std::hypot(double(p.x), double(p.z)));
      mean_lx += lx / 13;
      places.push_back({p, {0, 1, 0}, distance > 0 ? lx : 0});
    }
    const Errors hull = errors_at(by.hull, places, mean_lx);
    EXPECT_NEAR(hull.bias, 0, kSigmas * hull.error + 0.015) << distance;
    for (const auto& [kernel, maker] : by.kernels) {
      const Errors e = errors_at(*maker, places, mean_lx);
      const double share = test::kernel_share(kernel, static_cast<double>(distance));
      const double expected = distance > 0 ? share - 1 : share;
      EXPECT_NEAR(e.bias, expected, kSigmas * e.error + 0.015) << distance << " " << static_cast<int>(kernel);
      if (distance < 0.5f && distance > -0.3f) {
        EXPECT_LT(2 * hull.rmse, e.rmse) << distance;
      }
    }
  }
}

}  // namespace
}  // namespace phos
