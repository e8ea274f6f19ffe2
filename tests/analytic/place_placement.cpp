// Records on every surface: nothing that light reaches is left without, and solids stay empty.
#include "place/placement.h"

#include <gtest/gtest.h>

#include "place/on_surfaces.h"
#include "place/surface_sides.h"
#include "support/estimators.h"
#include "support/scenes.h"
#include "support/surface_points.h"

namespace phos {
namespace {

/// Six quads seen from outside (fronts outwards); the lower one is left out without `bottom`.
void add_box(Scene& scene, const Vec3& lo, const Vec3& hi, bool bottom) {
  const Vec3 d = hi - lo, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  if (bottom) test::add_quad(scene, lo, x, z);
  test::add_quad(scene, lo + y, z, x);
  test::add_quad(scene, lo, z, y);
  test::add_quad(scene, lo + x, y, z);
  test::add_quad(scene, lo, y, x);
  test::add_quad(scene, lo + z, x, y);
}

/// A floor of 1 km with a box of 1 m on it, a lamp above the box.
Scene floor_with_box(bool bottom = true) {
  Scene scene;
  test::begin_instance(scene, "floor", test::add_lambert(scene, "grey", 0.5f));
  test::add_quad(scene, {-500, 0, -500}, {0, 0, 1000}, {1000, 0, 0});
  test::begin_instance(scene, "box", 0);
  add_box(scene, {0, 0, 0}, {1, 1, 1}, bottom);
  test::add_point_light(scene, {0.3f, 3, 0.4f}, 1000);
  scene.camera.push_back(test::look_at({4, 3, 5}, {0, 0, 0}, {0, 1, 0}, 0.7f));
  finalize(scene);
  return scene;
}

struct Placed {
  IrradianceCache cache;
  PlacementReport report;
};

Placed place_everywhere(const RayScene& rays, double min_radius_m) {
  RecordOptions options;
  options.min_radius_m = min_radius_m;
  options.resolve(rays.scene().bounds.diagonal_m() / 4);
  Placed placed;
  placed.cache.accuracy = options.accuracy;
  Counters counters;
  placed.report = place_on_surfaces(placed.cache, test::DistanceEstimator(rays), rays, options, {}, counters);
  EXPECT_EQ(counters["sides inside solids passed over"], placed.report.sides_inside);
  return placed;
}

void expect_no_holes(const Scene& scene, double min_radius_m, const Vec3& lamp, std::size_t points = 20000) {
  const RayScene rays(scene);
  const Placed placed = place_everywhere(rays, min_radius_m);
  for (const test::Spread spread : {test::Spread::by_area, test::Spread::by_triangle}) {
    const auto lit = test::lit_points(rays, test::surface_points(rays, points, spread), lamp);
    EXPECT_GT(lit.size(), points / 10);
    EXPECT_LT(test::share_open(scene, placed.cache, lit), 1e-3);
  }
  EXPECT_LT(*placed.report.uncovered_share, 2 * kSurfaceShare);
}

TEST(SurfacePlacement, NoHolesInTheCornellBoxOfAnySize) {
  for (const float scale : {1.f, 1e-6f, 1e6f}) {
    const Scene scene = test::scaled(test::cornell(), scale);
    const double diagonal_m = scene.bounds.diagonal_m();
    expect_no_holes(scene, diagonal_m / 15, scale * Vec3(0.278f, 0.54f, 0.28f));
  }
}

TEST(SurfacePlacement, NoHolesOnThinWalls) {
  const test::AnalyticScene walls = test::thin_walls();
  expect_no_holes(walls.scene, 0.2, {0, 0, 1});
}

TEST(SurfacePlacement, NoHolesAroundSomethingTinyOnAHugeFloor) {
  for (const float scale : {1.f, 1e-4f, 1e4f}) {
    expect_no_holes(test::scaled(floor_with_box(), scale), 0.2 * static_cast<double>(scale),
                    scale * Vec3(0.3f, 3, 0.4f));
  }
}

/// Around the box alone, where a point chosen by area would never fall.
TEST(SurfacePlacement, NoHolesBesideTheTinyBox) {
  const Scene scene = floor_with_box();
  const RayScene rays(scene);
  const Placed placed = place_everywhere(rays, 0.2);
  std::vector<SurfacePoint> beside;
  for (int i = 0; i < 20000; ++i) {
    RandomStream random(8, Stage::test, static_cast<std::uint64_t>(i));
    const Vec3 from(-2 + 5 * random.uniform(), 1.5f, -2 + 5 * random.uniform());
    SurfacePoint p;
    ASSERT_TRUE(trace(rays, {from, {0, -1, 0}}, p));
    beside.push_back(p);
  }
  EXPECT_LT(test::share_open(scene, placed.cache, beside), 1e-3);
  EXPECT_LT(placed.cache.records.size(), 20000u);
}

std::uint64_t sides_inside(const Scene& scene) {
  const RayScene rays(scene);
  return place_everywhere(rays, static_cast<double>(scene.bounds.diagonal_m()) / 10).report.sides_inside;
}

TEST(SurfacePlacement, SolidsStayEmpty) {
  EXPECT_EQ(sides_inside(floor_with_box(true)), 12u);   // all of the box's inner sides
  EXPECT_EQ(sides_inside(floor_with_box(false)), 10u);  // the floor closes it

  Scene floating;
  test::begin_instance(floating, "box", test::add_lambert(floating, "grey", 0.5f));
  add_box(floating, Vec3(-1), Vec3(1), true);
  test::add_point_light(floating, {0, 3, 0}, 100);
  finalize(floating);
  EXPECT_EQ(sides_inside(floating), 12u);
  EXPECT_EQ(sides_inside(test::thin_walls().scene), 0u);
}

TEST(SurfacePlacement, TheFloorBelowABoxStaysEmpty) {
  const Scene scene = floor_with_box(false);
  const RayScene rays(scene);
  const Placed placed = place_everywhere(rays, 0.2);
  std::size_t floor = 0;
  for (const IrradianceRecord& r : placed.cache.records) {
    if (r.position.y > 0 || r.normal.y < 0.5f) continue;
    ++floor;
    const bool below =
        r.position.x > 0.01f && r.position.x < 0.99f && r.position.z > 0.01f && r.position.z < 0.99f;
    EXPECT_FALSE(below) << r.position.x << ' ' << r.position.z;
  }
  EXPECT_GT(floor, 20u);
}

TEST(SurfacePlacement, ARoomTurnedInsideOutIsNoSolid) {
  Scene scene;
  test::begin_instance(scene, "walls", test::add_lambert(scene, "grey", 0.5f));
  add_box(scene, Vec3(0), Vec3(2), true);  // fronts outwards, but the camera is inside
  test::add_point_light(scene, {1, 1.5f, 1}, 100);
  scene.camera.push_back(test::look_at({1, 1, 1}, {2, 1, 1}, {0, 1, 0}, 1));
  finalize(scene);
  EXPECT_EQ(sides_inside(scene), 0u);
  expect_no_holes(scene, 0.2, {1, 1.5f, 1});
}

TEST(SurfacePlacement, GlassIsNoSolidAndHasNoRecords) {
  Scene scene;
  test::begin_instance(scene, "ball", test::add_lambert(scene, "grey", 0.5f));
  add_box(scene, Vec3(-0.5f), Vec3(0.5f), true);
  Material glass;
  glass.name = "glass", glass.model = Model::dielectric;
  scene.material.push_back(glass);
  test::begin_instance(scene, "pane", 1);
  add_box(scene, Vec3(-1), Vec3(1), true);
  test::add_point_light(scene, {0, 3, 0}, 100);
  finalize(scene);
  const RayScene rays(scene);
  EXPECT_EQ(SurfaceSides(rays).sides().size(), 24u);  // those of the inner box
  const Placed placed = place_everywhere(rays, 0.2);
  EXPECT_EQ(placed.report.sides_inside, 12u);
  for (const IrradianceRecord& r : placed.cache.records) EXPECT_LE(glm::length(r.position), 0.9f);
  EXPECT_GT(placed.cache.records.size(), 6u);
}

}  // namespace
}  // namespace phos
