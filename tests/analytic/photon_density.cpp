// Photon density against closed forms: in every analytic scene, at every point with a known irradiance, the
// flux that lands on a disc about the point is the integral of the irradiance over the disc. A path of the
// run lands there by chance: the standard error of a sum of fluxes is the root of the sum of their squares,
// times a factor for paths that land there more than once: with an expected number m of landings per path,
// geometric over the bounces, the variance grows by at most 1 + 2 m.
#include <gtest/gtest.h>

#include "core/error.h"
#include "photon/trace.h"
#include "support/scenes.h"

namespace phos {
namespace {

constexpr double kSigmas = 4.8;  // two-sided 1.6e-6, for some hundred comparisons

struct Traced {
  PhotonMap map;
  PhotonTotals totals;
};

Traced traced(const Scene& scene, std::int64_t paths, std::uint64_t seed = 7) {
  const RayScene rays(scene);
  PhotonOptions options;
  options.paths = paths;
  PhotonTotals totals;
  Counters counters;
  Photons photons = trace_photons(rays, options, seed, totals, counters);
  return {PhotonMap::build(std::move(photons), totals), totals};
}

/// Mean of the closed form over a disc, by the midpoint rule in rings of equal area.
double disc_mean_lx(const test::AnalyticScene& s, const test::Check& check, float radius_m) {
  const Frame frame = make_frame(check.normal);
  constexpr int kRings = 40, kSpokes = 60;
  double sum = 0;
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kSpokes; ++j) {
      const float r = radius_m * std::sqrt((static_cast<float>(i) + 0.5f) / kRings);
      const float phi = 2 * kPi * (static_cast<float>(j) + 0.5f) / kSpokes;
      const Vec3 p = check.position + r * std::cos(phi) * frame.x + r * std::sin(phi) * frame.y;
      sum += s.irradiance_lx(p, check.normal);
    }
  return sum / (kRings * kSpokes);
}

void expect_densities(const test::AnalyticScene& s, std::int64_t paths) {
  const Traced t = traced(s.scene, paths);
  const float radius_m = 0.03f * s.scene.bounds.diagonal_m();
  std::vector<std::uint32_t> rows;
  for (const test::Check& check : s.checks) {
    SCOPED_TRACE(text(s.name, " at ", check.position.x, " ", check.position.y, " ", check.position.z,
                      ", normal ", check.normal.x, " ", check.normal.y, " ", check.normal.z));
    t.map.in_sphere(check.position, radius_m, rows);
    double flux = 0, squares = 0;
    for (const std::uint32_t i : rows) {
      const bool same_side = glm::dot(decode_octahedral(t.map.normal[i]), check.normal) > 0.9f;
      const float height_m = std::fabs(glm::dot(t.map.position[i] - check.position, check.normal));
      if (!same_side || height_m > 1e-4f * radius_m) continue;
      const double f = t.map.flux[i].x;
      flux += f, squares += f * f;
    }
    const double area_m2 = std::numbers::pi * double(radius_m) * double(radius_m);
    const double expected_lx = disc_mean_lx(s, check, radius_m);
    const double landings = flux / double(t.totals.emitted_flux_lm.x);
    const double error_lx = std::sqrt(squares * (1 + 2 * landings)) / area_m2;
    if (expected_lx == 0) {
      EXPECT_EQ(flux, 0) << "light where it is dark";
    } else {
      EXPECT_LT(error_lx, 0.12 * expected_lx) << "too few photons to tell";
      EXPECT_NEAR(flux / area_m2, expected_lx, kSigmas * error_lx);
    }
  }
}

TEST(PhotonDensity, EveryAnalyticScene) {
  for (const test::AnalyticScene& s : test::all_point_scenes())
    // Closed rooms: as many landings for every albedo.
    expect_densities(
        s, s.mean_irradiance_lx > 0 ? std::lround(100'000 * (1 - s.scene.material[0].kd.x)) : 300'000);
}

TEST(PhotonDensity, MicrometresAndThousandsOfKilometres) {
  for (const float scale : {1e-6f, 1e6f}) {
    expect_densities(test::scaled(test::point_light_over_plane(), scale), 100'000);
    expect_densities(test::scaled(test::furnace(0.5f), scale), 40'000);
    expect_densities(test::scaled(test::rectangle_light_parallel(), scale), 100'000);
  }
}

/// In a closed room of one reflectance rho every path carries the same flux P/N and lands K times, K
/// geometric with mean 1/(1-rho) and variance rho/(1-rho)^2, so that the stored flux is P/(1-rho) with
/// variance P^2 rho/(1-rho)^2 / N.
void expect_mean(const test::AnalyticScene& s, double albedo, std::int64_t paths) {
  SCOPED_TRACE(text(s.name, ", albedo ", albedo));
  const Traced t = traced(s.scene, paths);
  const double emitted_lm = double(t.totals.emitted_flux_lm.x);
  const double error_lx =
      emitted_lm * std::sqrt(albedo / double(paths)) / (1 - albedo) / s.area_m2 + 2e-6 * s.mean_irradiance_lx;
  EXPECT_NEAR(double(t.totals.stored_flux_lm.x) / s.area_m2, s.mean_irradiance_lx, kSigmas * error_lx);
  EXPECT_EQ(t.totals.escaped_sum.units[0], 0) << "a closed room leaks";
}

TEST(PhotonDensity, FurnaceAndIntegratingSphereMeans) {
  for (const float albedo : {0.1f, 0.5f, 0.9f, 0.99f}) {
    const std::int64_t paths = albedo > 0.95f ? 3'000 : 40'000;
    expect_mean(test::furnace(albedo), double(albedo), paths);
    expect_mean(test::integrating_sphere(albedo), double(albedo), paths);
    expect_mean(test::uniform_box(albedo), double(albedo), paths);
  }
}

}  // namespace
}  // namespace phos
