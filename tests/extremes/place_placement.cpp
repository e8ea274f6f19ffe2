// Placement where there is nothing to place on, and on shapes that are hard to cut.
#include "place/placement.h"

#include <gtest/gtest.h>

#include "place/modes.h"
#include "place/placement_options.h"
#include "support/estimators.h"
#include "support/scenes.h"
#include "support/surface_points.h"

namespace phos {
namespace {

struct Placed {
  IrradianceCache cache;
  PlacementReport report;
};

Placed place_in(const RayScene& rays, PlacementOptions placement, double min_radius_m,
                const PlacementSource& source = {}) {
  RecordOptions options;
  options.min_radius_m = min_radius_m;
  options.resolve(rays.scene().bounds.diagonal_m() / 4);
  resolve(placement, rays.scene(), source, options.accuracy);
  Placed placed;
  placed.cache.accuracy = options.accuracy;
  Counters counters;
  placed.report =
      extend_cache(placed.cache, test::DistanceEstimator(rays), rays, options, placement, source, counters);
  for (const IrradianceRecord& r : placed.cache.records) {
    EXPECT_TRUE(is_finite(r.position) && std::isfinite(r.radius_m) && r.radius_m > 0);
  }
  return placed;
}

Scene one_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  Scene scene;
  test::begin_instance(scene, "sliver", test::add_lambert(scene, "grey", 0.5f));
  test::add_triangle(scene, a, b, c);
  test::add_point_light(scene, {0, 1, 0}, 1);
  scene.camera.push_back(test::look_at({0, 1, 1}, {0, 0, 0}, {0, 1, 0}, 0.8f));
  finalize(scene);
  return scene;
}

TEST(PlacementExtremes, Slivers) {
  for (const float width : {1e-1f, 1e-3f, 1e-5f}) {
    const Scene scene = one_triangle({0, 0, 0}, {100, 0, 0}, {50, 0, width});
    const RayScene rays(scene);
    const Placed placed = place_in(rays, {.place = Place::surface}, 1);
    EXPECT_LT(test::share_open(scene, placed.cache, test::surface_points(rays, 2000, test::Spread::by_area)),
              1e-3)
        << width;
    // A zone reaches 5 m at most: each side needs ten records at least, and not many more.
    EXPECT_GE(placed.cache.records.size(), 20u);
    EXPECT_LT(placed.cache.records.size(), 200u);
  }
}

TEST(PlacementExtremes, NoPointsAndNoView) {
  const Scene scene = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  const RayScene rays(scene);
  for (const Place mode : {Place::given, Place::every}) {
    const Placed placed = place_in(rays, {.place = mode}, 0.1, {.points_given = true});
    EXPECT_TRUE(placed.cache.records.empty());
    EXPECT_EQ(placed.report.candidates, 0u);
  }
  Scene away = scene;
  away.camera[0] = test::look_at({0, 1, 1}, {0, 2, 2}, {0, 1, 0}, 0.8f);
  const RayScene empty_view(away);
  EXPECT_TRUE(place_in(empty_view, {.place = Place::view}, 0.1).cache.records.empty());
  Scene blind = scene;
  blind.camera.clear();
  const RayScene no_camera(blind);
  EXPECT_ANY_THROW(place_in(no_camera, {.place = Place::view}, 0.1));
}

TEST(PlacementExtremes, AViewOfOnePixelAndOfALine) {
  const Scene scene = test::furnace(0.5f).scene;
  const RayScene rays(scene);
  EXPECT_GE(place_in(rays, {.place = Place::view, .width = 1, .height = 1}, 0.1).cache.records.size(), 1u);
  const Placed line = place_in(rays, {.place = Place::view, .width = 300, .height = 1}, 0.1);
  EXPECT_EQ(line.report.candidates, 4u * 300);
  EXPECT_EQ(line.report.uncovered, 0u);
}

TEST(PlacementExtremes, ManyPointsAtOnePlace) {
  const Scene scene = test::furnace(0.5f).scene;
  const RayScene rays(scene);
  const std::vector<SurfaceSample> points(5000, SurfaceSample{{1, 0, 1}, {0, 1, 0}});
  const PlacementSource source{.points_given = true, .points = points};
  EXPECT_EQ(place_in(rays, {.place = Place::given}, 0.1, source).cache.records.size(), 1u);
  EXPECT_EQ(place_in(rays, {.place = Place::every}, 0.1, source).cache.records.size(), 5000u);
}

TEST(PlacementExtremes, ASceneOfMirrorsAloneWantsNoRecords) {
  Scene scene;
  Material mirror;
  mirror.name = "mirror", mirror.model = Model::mirror, mirror.ks = Rgb(0.9f);
  scene.material.push_back(mirror);
  test::begin_instance(scene, "mirrors", 0);
  test::add_room(scene, Vec3(0), Vec3(1));
  test::add_point_light(scene, Vec3(0.5f), 1);
  scene.camera.push_back(test::look_at({0.3f, 0.4f, 0.6f}, {1, 0.5f, 0.5f}, {0, 1, 0}, 0.8f));
  finalize(scene);
  const RayScene rays(scene);
  EXPECT_TRUE(place_in(rays, {.place = Place::surface}, 0.1).cache.records.empty());
  EXPECT_TRUE(place_in(rays, {.place = Place::view, .width = 16, .height = 16}, 0.1).cache.records.empty());
}

}  // namespace
}  // namespace phos
