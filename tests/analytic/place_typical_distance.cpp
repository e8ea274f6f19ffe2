// The distance by which radii are chosen: closed forms, published values, and a far ground that changes
// nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "photon/trace.h"
#include "place/modes.h"
#include "place/placement_options.h"
#include "place/typical_distance.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

/// Seen from within a sphere's surface, a chord is 2 R cos long, and the cosine-weighted mean of its inverse
/// is 1 / R.
TEST(TypicalDistance, OfASphereIsItsRadius) {
  Scene sphere;
  begin_instance(sphere, "sphere", add_lambert(sphere, "grey", 0.5f));
  constexpr int kRings = 64, kSlices = 128;
  const auto at = [](int ring, int slice) {
    const float t = kPi * static_cast<float>(ring) / kRings,
                f = 2 * kPi * static_cast<float>(slice) / kSlices;
    return 3.f * Vec3(std::sin(t) * std::cos(f), std::cos(t), std::sin(t) * std::sin(f));
  };
  for (int r = 0; r < kRings; ++r) {
    for (int s = 0; s < kSlices; ++s) {
      if (r > 0) add_triangle(sphere, at(r, s), at(r, s + 1), at(r + 1, s));
      if (r + 1 < kRings) add_triangle(sphere, at(r + 1, s), at(r, s + 1), at(r + 1, s + 1));
    }
  }
  finalize(sphere);
  const RayScene rays(sphere);
  std::vector<SurfaceSample> places;
  RandomStream random(1, Stage::placement, 0);
  for (int i = 0; i < 200; ++i) {
    const float z = 2 * random.uniform() - 1, f = 2 * kPi * random.uniform(), s = std::sqrt(1 - z * z);
    const Vec3 n(s * std::cos(f), z, s * std::sin(f));
    places.push_back({2.995f * n, -n});
  }
  // Rays that graze are cut short by the triangles' flatness: some per cent.
  EXPECT_NEAR(typical_distance_m(rays, places), 3, 0.12);
  // What is far changes nothing.
  add_quad(sphere, {-200, -60, -200}, {0, 0, 400}, {400, 0, 0});
  finalize(sphere);
  EXPECT_NEAR(typical_distance_m(RayScene(sphere), places), 3, 0.12);
}

/// Two wide planes h apart: the mean of cos / h is 2 / (3 h).
TEST(TypicalDistance, BetweenPlanes) {
  Scene planes;
  begin_instance(planes, "planes", add_lambert(planes, "grey", 0.5f));
  add_quad(planes, {-1000, 0, -1000}, {0, 0, 2000}, {2000, 0, 0});
  add_quad(planes, {-1000, 2, -1000}, {2000, 0, 0}, {0, 0, 2000});
  finalize(planes);
  const std::vector<SurfaceSample> places(64, {{0, 0, 0}, {0, 1, 0}});
  EXPECT_NEAR(typical_distance_m(RayScene(planes), places), 3, 0.03);
  // No place, and places from which nothing is seen: the scene's own size.
  EXPECT_NEAR(typical_distance_m(RayScene(planes), {}), planes.bounds.diagonal_m() / 4, 1);
  const std::vector<SurfaceSample> outside(64, {{0, 0, 0}, {0, -1, 0}});
  EXPECT_NEAR(typical_distance_m(RayScene(planes), outside), planes.bounds.diagonal_m() / 4, 1);
}

/// 4 x 5 x 2.7 m with a window, as docs/methods.md#v1: 1.74 m; with ground, and with a backdrop too, 1.77
/// and 1.81 m (from one view of its own; ours differs a little).
struct Room {
  explicit Room(int surroundings) {
    begin_instance(scene, "room", add_lambert(scene, "grey", 0.5f));
    add_quad(scene, {0, 0, 0}, {0, 0, 5}, {4, 0, 0});     // floor
    add_quad(scene, {0, 2.7f, 0}, {4, 0, 0}, {0, 0, 5});  // ceiling
    add_quad(scene, {0, 0, 0}, {0, 2.7f, 0}, {0, 0, 5});  // sides
    add_quad(scene, {4, 0, 0}, {0, 0, 5}, {0, 2.7f, 0});
    add_quad(scene, {0, 0, 5}, {0, 2.7f, 0}, {4, 0, 0});  // behind the camera
    add_quad(scene, {0, 0, 0}, {4, 0, 0}, {0, 0.9f, 0});  // about a window of 2 x 1.5 m
    add_quad(scene, {0, 2.4f, 0}, {4, 0, 0}, {0, 0.3f, 0});
    add_quad(scene, {0, 0.9f, 0}, {1, 0, 0}, {0, 1.5f, 0});
    add_quad(scene, {3, 0.9f, 0}, {1, 0, 0}, {0, 1.5f, 0});
    if (surroundings > 0) add_quad(scene, {-150, -0.1f, -150}, {0, 0, 300}, {300, 0, 0});
    if (surroundings > 1) add_quad(scene, {-2000, -1000, -2000}, {4000, 0, 0}, {0, 2000, 0});
    add_point_light(scene, {2, 2.2f, 2.5f}, 100);
    scene.camera.push_back(look_at({2, 1.6f, 4.8f}, {2, 1.2f, 0}, {0, 1, 0}, 0.9f));
    finalize(scene);
  }
  Scene scene;
};

TEST(TypicalDistance, AFarGroundChangesNothing) {
  float seen_m[3], lit_m[3];
  for (int i = 0; i < 3; ++i) {
    const Room room(i);
    const RayScene rays(room.scene);
    seen_m[i] = typical_distance_m(rays, seen_places(rays, ""));
    PhotonOptions options;
    options.paths = 20000;
    PhotonTotals totals;
    Counters counters;
    const PhotonMap photons = PhotonMap::build(trace_photons(rays, options, 1, totals, counters), totals);
    lit_m[i] = typical_distance_m(rays, lit_places(photons));
    PlacementOptions placement;
    placement.place = Place::photons;
    PlacementSource source;
    source.photons = &photons;
    const TypicalDistance both = typical_distance(rays, placement, source);
    EXPECT_EQ(both.least_m, std::min(seen_m[i], lit_m[i]));
    EXPECT_EQ(both.most_m, std::max(seen_m[i], lit_m[i]));
  }
  EXPECT_NEAR(seen_m[0], 1.74, 0.2);
  for (int i = 1; i < 3; ++i) {
    EXPECT_NEAR(seen_m[i], seen_m[0], 0.15 * static_cast<double>(seen_m[0])) << i;
    EXPECT_NEAR(lit_m[i], lit_m[0], 0.1 * static_cast<double>(lit_m[0])) << i;
  }
}

/// The programs' own scenes, with a ground plane of 300 m below them: as many records, as large.
TEST(TypicalDistance, AGroundUnderEveryScene) {
  for (const char* name : {"cornell-empty", "cornell-glossy22", "cornell-measured", "cube-in-a-box",
                           "moving-light", "spheres"}) {
    float typical_m[2];
    for (const bool ground : {false, true}) {
      Scene scene = load_scene(std::string(PHOS_SOURCE "/data/") + name + ".glb");
      if (ground) {
        const float below = scene.bounds.lo.y - 0.1f * scene.bounds.diagonal_m();
        begin_instance(scene, "ground", add_lambert(scene, "ground", 0.2f));
        add_quad(scene, {-150, below, -150}, {0, 0, 300}, {300, 0, 0});
        if (!scene.uv0.empty()) scene.uv0.resize(scene.position.size());
        if (!scene.uv1.empty()) scene.uv1.resize(scene.position.size());
        finalize(scene);
      }
      const RayScene rays(scene);
      const TypicalDistance typical = typical_distance(rays, {}, {});
      typical_m[ground] = typical.least_m;
    }
    EXPECT_NEAR(typical_m[1], typical_m[0], 0.25 * static_cast<double>(typical_m[0])) << name;
  }
}

}  // namespace
}  // namespace phos::test
