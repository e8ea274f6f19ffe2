// Photons of skies and suns: what lands in the open; and aimed at openings, the same light as of those that
// are not.
#include <gtest/gtest.h>

#include "core/error.h"
#include "photon/emission.h"
#include "photon/portals.h"
#include "photon/trace.h"
#include "scene/opening/find_portals.h"
#include "scene/sky/access.h"
#include "support/daylight.h"

namespace phos::test {
namespace {

/// Aimed at portals, if any are named.
Photons photons_of(Scene scene, const std::string& portals, std::int64_t paths, std::uint64_t seed = 1) {
  const RayScene rays(scene);
  if (!portals.empty()) scene.portal = find_portals(rays, portals);
  PhotonOptions options;
  options.paths = paths;
  PhotonTotals totals;
  Counters counters;
  return trace_photons(rays, options, seed, totals, counters);
}

struct Light {
  double lx = 0, error_lx = 0;
  std::size_t photons = 0;
};

/// On the floor's upper side.
Light floor_light(const Scene& scene, const std::string& portals, std::int64_t paths,
                  std::uint64_t seed = 1) {
  const Photons photons = photons_of(scene, portals, paths, seed);
  // Bounces of a path count one by one: nearly independent.
  double sum = 0, squares = 0;
  Light light;
  const double size_m = static_cast<double>(scene.bounds.size().x) / 5;
  const float lift_m = 1e-3f * scene.bounds.size().y;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (photons.position[i].y > scene.bounds.lo.y + lift_m || decode_octahedral(photons.normal[i]).y < 0.5f)
      continue;
    const auto lm = static_cast<double>(photons.flux[i].x);
    sum += lm, squares += lm * lm, ++light.photons;
  }
  const double area_m2 = 20 * size_m * size_m;
  light.lx = sum / area_m2, light.error_lx = std::sqrt(squares) / area_m2;
  return light;
}

void expect_alike(const Light& a, const Light& b, const std::string& what) {
  EXPECT_NEAR(a.lx, b.lx, 4 * std::hypot(a.error_lx, b.error_lx)) << what;
}

/// Light through the hole on the floor of a black room, its mean.
double direct_lx(const Environment& sky) {
  constexpr int n = 30;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      sum += through_window_lx({5 * (i + 0.5) / n, 0, 4 * (k + 0.5) / n},
                               [&](const DVec3& w) { return static_cast<double>(sky.luminance(Vec3(w)).x); });
  return sum / (n * n);
}

}  // namespace

/// Every type brings the horizontal illuminance that was asked for; so does a sun, times the sine of its
/// height.
TEST(Daylight, LandsOnAnOpenFloor) {
  for (int type = 1; type <= 17; ++type) {
    Scene scene = open_floor(1, 0);
    const bool sun = type == 17;
    surround(scene, sun ? sky_of("", "77,25", 0, 1000 / std::sin(glm::radians(25.0)))
                        : sky_of("cie:" + std::to_string(type), "77,25", 1000, 0));
    const RayScene rays(scene);
    PhotonOptions options;
    options.paths = 100000;
    PhotonTotals totals;
    Counters counters;
    const Photons photons = trace_photons(rays, options, 1, totals, counters);
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
      if (decode_octahedral(photons.normal[i]).y < 0.5f) continue;
      const auto lm = static_cast<double>(photons.flux[i].x);
      sum += lm, squares += lm * lm;
    }
    EXPECT_NEAR(sum / 4, 1000, 4 * std::sqrt(squares) / 4) << type;
    EXPECT_LT(std::sqrt(squares) / 4, 8) << type;
  }
}

/// Aimed or not, with named or found portals: the closed form, at a tenth of the noise and less.
TEST(Portals, BringWhatComesThroughTheHole) {
  for (const char* type : {"overcast", "clear"}) {
    const bool clear = std::string(type) == "clear";
    // The sun in the north: no beam through the hole, which faces +Z, south.
    const Environment sky = sky_of(type, clear ? "20,35" : "");
    const double truth = direct_lx(sky);
    for (const bool pane : {false, true}) {
      Scene scene = room_with_window(0, pane);
      surround(scene, sky);
      const Light plain = floor_light(scene, "", 400000), found = floor_light(scene, "auto", 100000);
      EXPECT_NEAR(found.lx, truth, 4 * found.error_lx + 2e-3 * truth) << type << pane;
      EXPECT_NEAR(plain.lx, truth, 4 * plain.error_lx + 2e-3 * truth) << type << pane;
      EXPECT_LT(found.error_lx, 0.4 * plain.error_lx);
      EXPECT_GT(found.photons, 5 * plain.photons);
      if (!pane) continue;
      const Light named = floor_light(scene, "pane", 100000);
      EXPECT_NEAR(named.lx, truth, 4 * named.error_lx + 2e-3 * truth) << type;
      EXPECT_GT(named.photons, 5 * plain.photons);
      expect_alike(floor_light(scene, "glass", 100000, 2), named, "by material");
    }
  }
}

/// With walls that reflect, and the sun's beam through the hole.
TEST(Portals, AgreeWithPhotonsThatAreNotAimed) {
  for (const char* sun : {"180,40", "160,20"}) {
    Scene scene = room_with_window(0.6f);
    surround(scene, sky_of("clear", sun));
    const Light plain = floor_light(scene, "", 1000000), found = floor_light(scene, "auto", 200000);
    expect_alike(plain, found, sun);
    EXPECT_GT(found.photons, plain.photons);
    // Portals that miss most of the light are none the less right.
    Scene misled = room_with_window(0.6f);
    begin_instance(misled, "elsewhere", add_lambert(misled, "black", 0));
    add_quad(misled, {4, 0.2f, 3.9f}, {0, 0.5f, 0}, {0.5f, 0, 0});
    surround(misled, sky_of("clear", sun));
    expect_alike(floor_light(misled, "", 1000000), floor_light(misled, "elsewhere", 1000000), "misled");
  }
}

struct CeilingLight {
  double lm = 0, squares = 0, most = 0;
  std::size_t photons = 0;
};

CeilingLight ceiling_light(Scene scene, const std::string& portals, std::int64_t paths) {
  const Photons photons = photons_of(std::move(scene), portals, paths);
  CeilingLight c;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (decode_octahedral(photons.normal[i]).y > -0.5f || photons.position[i].y < 1) continue;
    const auto lm = static_cast<double>(photons.flux[i].x);
    c.lm += lm, c.squares += lm * lm, c.most = std::max(c.most, lm), ++c.photons;
  }
  return c;
}

/// Light that the ground reflects comes in by photons of like flux too, though paths that are not aimed carry
/// thousands of times as much: the ceiling of a black room gets no other.
TEST(Portals, LightFromTheGroundIsEven) {
  for (const bool pane : {false, true}) {
    Scene scene = room_with_window(0, pane);
    if (pane) scene.material[1].ior = 1.5f;
    begin_instance(scene, "ground", add_lambert(scene, "ground", 0.5f));
    add_quad(scene, {-40, -0.01f, -40}, {0, 0, 80}, {80, 0, 0});
    surround(scene, sky_of("overcast", "", 10000));
    const CeilingLight plain = ceiling_light(scene, "", 8000000),
                       aimed = ceiling_light(scene, "auto", 200000);
    EXPECT_NEAR(aimed.lm / plain.lm, 1, 4 * std::sqrt(plain.squares) / plain.lm + 0.04) << pane;
    EXPECT_GT(aimed.photons, 1000u);
    EXPECT_LT(aimed.most, 20 * aimed.lm / static_cast<double>(aimed.photons)) << "none outshines the rest";
  }
}

/// Smaller or larger by a million, the same lux.
TEST(Portals, HoldAtEverySize) {
  const Environment sky = sky_of("clear", "180,40");
  Scene scene = room_with_window(0.5f);
  surround(scene, sky);
  const Light metres = floor_light(scene, "auto", 100000);
  for (const float factor : {1e-6f, 1e6f}) {
    Scene other = scaled(room_with_window(0.5f), factor);
    surround(other, sky);
    const Light light = floor_light(other, "auto", 100000);
    EXPECT_NEAR(light.lx / metres.lx, 1, 0.02) << factor;
    EXPECT_NEAR(static_cast<double>(light.photons) / static_cast<double>(metres.photons), 1, 0.02) << factor;
  }
}

/// Of what is emitted, the expected sum is the light through the bounding sphere's disc, as without portals.
TEST(Portals, EmitTheSameInAll) {
  Scene scene = room_with_window(0.5f);
  surround(scene, sky_of("clear", "180,40"));
  scene.portal = named_portals(scene, "walls");
  constexpr std::uint64_t kPaths = 200000;
  const Emitter emitter(scene, 0.1, kPaths, 1);
  double sum = 0, squares = 0;
  for (std::uint64_t i = 0; i < kPaths; ++i) {
    RandomStream random(1, Stage::photon_path, i);
    random.start_bounce(0);
    const auto lm = static_cast<double>(emitter.emit(i, random).flux_lm.x);
    sum += lm, squares += lm * lm;
  }
  const auto truth = static_cast<double>(scene.light[0].flux_lm.x);
  EXPECT_NEAR(sum / truth, 1, 4 * std::sqrt(squares) / truth);
  EXPECT_LT(std::sqrt(squares) / truth, 0.02);
}

TEST(Portals, KnowTheirInside) {
  Scene scene = room_with_window(0.5f, true);
  surround(scene, sky_of("overcast", "", 1000));
  const RayScene rays(scene);
  const std::vector<Portal> panes = find_portals(rays, "pane");
  ASSERT_EQ(panes.size(), 2u);
  for (const Portal& p : panes) EXPECT_EQ(p.inwards, Vec3(0, 0, -1));
}

TEST(Portals, AreNotFoundWhereNothingIsWithin) {
  Scene open = open_floor();
  surround(open, sky_of("overcast", ""));
  EXPECT_TRUE(find_portals(RayScene(open), "auto").empty());
  Scene closed = room_with_window(0.5f, false, false);
  closed.camera.push_back(look_at({1, 1, 1}, {2, 1, 1}, {0, 1, 0}, 1));
  surround(closed, sky_of("overcast", ""));
  EXPECT_TRUE(find_portals(RayScene(closed), "auto").empty());
  EXPECT_TRUE(closed_to_the_sky(RayScene(closed)));
  Scene with_hole = room_with_window(0.5f);
  with_hole.camera = closed.camera;
  surround(with_hole, sky_of("overcast", ""));
  EXPECT_FALSE(closed_to_the_sky(RayScene(with_hole)));
  EXPECT_FALSE(find_portals(RayScene(with_hole), "auto").empty());
  EXPECT_THROW(named_portals(with_hole, "walls,window"), Error);
}

}  // namespace phos::test
