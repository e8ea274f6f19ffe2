// Photons from an environment: what lands is what arrives.
#include <gtest/gtest.h>

#include "photon/emission.h"
#include "photon/trace.h"
#include "support/environment.h"

namespace phos::test {
namespace {

struct Landed {
  Photons photons;
  PhotonTotals totals;
};

Landed trace(const Scene& scene, std::int64_t paths) {
  const RayScene rays(scene);
  Landed landed;
  Counters counters;
  PhotonOptions options;
  options.paths = paths;
  landed.photons = trace_photons(rays, options, 1, landed.totals, counters);
  return landed;
}

/// Light on the floor's upper or lower side, lx, from all that landed there, and its standard error.
std::pair<double, double> floor_lx(const Landed& landed, float side, double area_m2, double paths) {
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < landed.photons.position.size(); ++i) {
    if (side * decode_octahedral(landed.photons.normal[i]).y < 0.5f) continue;
    const auto flux = static_cast<double>(landed.photons.flux[i].x);
    sum += flux, squares += flux * flux;
  }
  const double variance = squares - sum * sum / paths;
  return {sum / area_m2, std::sqrt(std::max(variance, 0.0)) / area_m2};
}

/// Emitted in all is the light through the bounding sphere's disc, whatever the map.
TEST(Environment, EmitsItsFlux) {
  Scene scene = open_floor();
  const Environment map = gradient_map(32, 1);
  surround(scene, map);
  const double radius_m = static_cast<double>(bounding_radius_m(scene));
  constexpr std::uint64_t kPaths = 20000;
  const Emitter emitter(scene, 0.1, kPaths, 1);
  DVec3 sum(0), squares(0);
  for (std::uint64_t i = 0; i < kPaths; ++i) {
    RandomStream random(1, Stage::photon_path, i);
    random.start_bounce(0);
    const EmittedPhoton photon = emitter.emit(i, random);
    EXPECT_TRUE(photon.from_infinity);
    EXPECT_EQ(photon.source_normal, photon.ray.direction);
    // The disc lies before the sphere, and every ray of it meets the sphere.
    const Vec3 way = scene.bounds.centre() - photon.ray.origin;
    const float along = glm::dot(way, photon.ray.direction);
    EXPECT_NEAR(along, 1.001f * bounding_radius_m(scene), 1e-4f);
    EXPECT_LE(glm::length(way - along * photon.ray.direction), bounding_radius_m(scene) * 1.0001f);
    const DVec3 flux(photon.flux_lm);
    sum += flux, squares += flux * flux;
  }
  const DVec3 truth = map.integral_lx() * (std::numbers::pi * radius_m * radius_m);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(sum[c], truth[c], 4 * std::sqrt(squares[c] - sum[c] * sum[c] / kPaths) + 1e-4 * truth[c]);
  // Luminance is what photons are chosen by: each brings the same.
  EXPECT_NEAR(0.2126 * sum.x + 0.7152 * sum.y + 0.0722 * sum.z,
              0.2126 * truth.x + 0.7152 * truth.y + 0.0722 * truth.z, 1e-4 * truth.y);
}

TEST(Environment, LightsBothSidesOfAPlane) {
  for (const float metres : {1e-6f, 1.f, 1e6f}) {
    Scene scene = open_floor(metres, 0);
    const Environment map = gradient_map(32);
    surround(scene, map);
    constexpr std::int64_t kPaths = 200000;
    const Landed landed = trace(scene, kPaths);
    const double area_m2 = 4.0 * static_cast<double>(metres) * static_cast<double>(metres);
    const auto [up, up_error] = floor_lx(landed, 1, area_m2, kPaths);
    EXPECT_NEAR(up, map.irradiance_up_lx().x, 4 * up_error) << metres;
    EXPECT_LT(up_error, 0.01 * up);
    // From below, the same map upside down.
    const Environment turned =
        map_of(32, [&](int x, int y) { return map.texels()[static_cast<std::size_t>((31 - y) * 64 + x)]; });
    const auto [down, down_error] = floor_lx(landed, -1, area_m2, kPaths);
    EXPECT_NEAR(down, turned.irradiance_up_lx().x, 4 * down_error) << metres;
    for (const float d : landed.photons.distance) EXPECT_EQ(d, kInfinity);
    for (const std::uint8_t path : landed.photons.path)
      EXPECT_EQ(path, static_cast<std::uint8_t>(PhotonPath::direct));
  }
}

/// Beside a lamp, each has its share of the paths.
TEST(Environment, SharesThePathsWithLamps) {
  Scene scene = open_floor();
  add_point_light(scene, {0, 1, 0}, 5);
  surround(scene, constant_map(8, Rgb(1)));
  ASSERT_EQ(scene.light.size(), 2u);
  const Emitter emitter(scene, 0, 1000, 1);
  const double lamp = 20 * std::numbers::pi, sky = 4 * std::numbers::pi * std::numbers::pi * 2;
  EXPECT_NEAR(emitter.share(0), lamp / (lamp + sky), 1e-4);
  EXPECT_NEAR(emitter.share(1), sky / (lamp + sky), 1e-4);
}

}  // namespace
}  // namespace phos::test
