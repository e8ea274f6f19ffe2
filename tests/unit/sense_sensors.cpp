// Grids of sensors, the table they are written to, and its summary.
#include <gtest/gtest.h>

#include <set>

#include "core/error.h"
#include "core/parallel.h"
#include "direct/direct_light.h"
#include "scene/inside_solid.h"
#include "sense/grid.h"
#include "sense/sensor_table.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

GridOptions on_mesh(const std::string& node, double spacing_m, double margin_m = 0) {
  GridOptions grid;
  grid.spacing_m = spacing_m, grid.mesh = node, grid.margin_m = margin_m;
  return grid;
}

GridOptions at_height(double height_m, double spacing_m, double margin_m = 0) {
  GridOptions grid;
  grid.spacing_m = spacing_m, grid.height_m = height_m, grid.margin_m = margin_m;
  return grid;
}

Scene desk(float turn_rad, float size = 1) {
  Scene scene;
  begin_instance(scene, "room", add_lambert(scene, "grey", 0.5f));
  add_room(scene, size * Vec3(-3), size * Vec3(3));
  begin_instance(scene, "desk", 0);
  const Vec3 u = size * Vec3(2 * std::cos(turn_rad), 0, 2 * std::sin(turn_rad)),
             v = size * Vec3(std::sin(turn_rad), 0, -std::cos(turn_rad));
  add_quad(scene, size * Vec3(0.1f, -1, 0.2f), u, v);
  finalize(scene);
  return scene;
}

TEST(SensorGrid, ADeskCarriesARegularGridHoweverItStands) {
  for (const float turn : {0.f, 0.3f, 1.2f, 2.9f}) {
    const Sensors s = mesh_grid(desk(turn), on_mesh("desk", 0.25));
    ASSERT_EQ(s.points.size(), 8u * 4u) << turn;
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      EXPECT_NEAR(s.points[i].position.y, -1, 1e-5);
      EXPECT_NEAR(s.points[i].normal.y, 1, 1e-5);
      float nearest = 9;
      for (std::size_t k = 0; k < s.points.size(); ++k)
        if (k != i) nearest = std::min(nearest, glm::distance(s.points[i].position, s.points[k].position));
      EXPECT_NEAR(nearest, 0.25f, 1e-5);
    }
  }
  // 2 x 1 m less 0.2 m all round leaves room for 1.6 x 0.6 m: 3 x 1 cells of half a metre.
  EXPECT_EQ(mesh_grid(desk(0.3f), on_mesh("desk", 0.5, 0.2)).points.size(), 3u);
  EXPECT_EQ(mesh_grid(desk(0.3f), on_mesh("desk", 0.5, 0.6)).points.size(), 0u);
  EXPECT_EQ(mesh_grid(desk(0), on_mesh("desk", 50)).points.size(), 1u);
  for (const float size : {1e-6f, 1e6f})
    EXPECT_EQ(mesh_grid(desk(0.3f, size), on_mesh("desk", 0.25 * double(size))).points.size(), 32u);
}

TEST(SensorGrid, CurvedMeshesHavePointsByTheirArea) {
  Scene ball = integrating_sphere(0.5f, 5120).scene;
  for (const double spacing : {0.02, 0.1, 0.3}) {
    const Sensors s = mesh_grid(ball, on_mesh(ball.instance[0].node, spacing));
    const double expected = 4 * std::numbers::pi / (spacing * spacing);
    EXPECT_NEAR(static_cast<double>(s.points.size()), expected, 0.1 * expected + 12) << spacing;
    for (const SurfaceSample& p : s.points) EXPECT_NEAR(glm::length(p.position), 1, 0.01);
  }
}

TEST(SensorGrid, UnknownNodesAreNamed) {
  try {
    mesh_grid(desk(0), on_mesh("table", 0.5));
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    EXPECT_NE(std::string(e.what()).find("room, desk"), std::string::npos);
  }
  EXPECT_THROW(mesh_grid(desk(0), on_mesh("room", 1e-9)), Error);
}

/// A room of 6 m whose floor lies at -3, with a solid block of 2 m a side in a corner.
Scene furnished() {
  Scene scene;
  begin_instance(scene, "room", add_lambert(scene, "grey", 0.5f));
  add_room(scene, Vec3(-3), Vec3(3));
  begin_instance(scene, "block", 0);
  const Vec3 lo(-2.99f), x(1.99f, 0, 0), y(0, 1.99f, 0), z(0, 0, 1.99f);
  add_quad(scene, lo, z, y), add_quad(scene, lo + x, y, z);  // fronts outwards
  add_quad(scene, lo, y, x), add_quad(scene, lo + z, x, y);
  add_quad(scene, lo, x, z), add_quad(scene, lo + y, z, x);
  finalize(scene);
  return scene;
}

TEST(SensorGrid, AWorkplaneLiesOverTheFloorAndAvoidsSolidsAndWalls) {
  const Scene scene = furnished();
  const RayScene rays(scene);
  EXPECT_EQ(floor_level_m(rays, Axis::y), -3);
  const Sensors all = workplane(rays, at_height(2.5, 1));
  EXPECT_EQ(all.points.size(), 36u);
  EXPECT_EQ(all.left_out, 0u);
  const Sensors low = workplane(rays, at_height(0.8, 1));
  EXPECT_EQ(low.points.size(), 32u);
  EXPECT_EQ(low.left_out, 4u);
  EXPECT_NEAR(*low.level_m, -2.2f, 1e-6);
  for (const SurfaceSample& p : low.points) {
    EXPECT_NEAR(p.position.y, -2.2f, 1e-6);
    EXPECT_EQ(p.normal, Vec3(0, 1, 0));
  }
  // 0.6 m clear of the walls leaves 4.8 m, 4 x 4 cells: one is in the block, two stand half a metre beside
  // it.
  const Sensors clear = workplane(rays, at_height(0.8, 1, 0.6));
  EXPECT_EQ(clear.points.size(), 13u);
  EXPECT_EQ(clear.left_out, 3u);
}

TEST(SensorGrid, OutdoorsThereIsNoWorkplane) {
  const AnalyticScene s = thin_walls();  // two walls and no floor
  const RayScene rays(s.scene);
  const Sensors none = workplane(rays, at_height(0.5, 0.1));
  EXPECT_TRUE(none.points.empty());
  EXPECT_GT(none.left_out, 0u);
}

TEST(Sensors, InsideAndOutsideOfSolids) {
  const Scene scene = furnished();
  const RayScene rays(scene);
  const auto inside = [&](const Vec3& p) { return inside_solid(rays, receiver(scene, p, {0, 1, 0})); };
  EXPECT_TRUE(inside({-2, -2, -2}));
  EXPECT_TRUE(inside({-2, -4, -2}));  // under the floor
  EXPECT_FALSE(inside({-2, -0.5f, -2}));
  EXPECT_FALSE(inside({1, -3, 1}));
  EXPECT_FALSE(inside({-2, -1, -2}));  // on the block
}

/// A room whose fronts face outwards, as energy models have them, double-sided; its north wall may be open. A
/// box of the same material, closed, and one of one-sided walls stand in it.
struct OutwardRoom {
  bool open = false, lamp = false;
  Scene scene() const {
    Scene s;
    const std::uint32_t both = add_lambert(s, "both", 0.5f), one = add_lambert(s, "one", 0.5f);
    s.material[both].double_sided = true;
    const auto box = [&](const char* name, std::uint32_t material, const Vec3& lo, const Vec3& hi,
                         bool lidless) {
      begin_instance(s, name, material);
      const Vec3 d = hi - lo, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
      add_quad(s, lo, z, y), add_quad(s, lo + x, y, z);  // fronts outwards
      if (!lidless) add_quad(s, lo, y, x);
      add_quad(s, lo + z, x, y), add_quad(s, lo, x, z), add_quad(s, lo + y, z, x);
    };
    box("room", both, Vec3(-3), Vec3(3), open);
    box("chest", both, Vec3(-2.5f), Vec3(-1.5f), false);
    box("block", one, Vec3(1.5f, -2.5f, 1.5f), Vec3(2.5f, -1.5f, 2.5f), false);
    if (lamp) {
      Light light;
      light.intensity = Rgb(100);
      s.light.push_back(light);
    }
    finalize(s);
    return s;
  }
};

TEST(Sensors, RoomsWhoseDoubleSidedFrontsFaceOutwardsAreNoSolids) {
  for (const OutwardRoom& room : {OutwardRoom{true, false}, OutwardRoom{false, true}}) {
    const Scene scene = room.scene();
    const RayScene rays(scene);
    const auto inside = [&](const Vec3& p) { return inside_solid(rays, receiver(scene, p, {0, 1, 0})); };
    EXPECT_FALSE(inside({0.3f, -2.9f, 0.2f}));
    EXPECT_FALSE(inside({-2.9f, -2.9f, -2.9f}));  // behind the chest
    EXPECT_FALSE(inside({5, 0, 0}));
    EXPECT_TRUE(inside({-2, -2, -2}));
    EXPECT_TRUE(inside({2, -2, 2}));
  }
  // No light gets into it: nobody can tell such a room from a solid.
  const Scene dark = OutwardRoom{}.scene();
  const RayScene rays(dark);
  EXPECT_TRUE(inside_solid(rays, receiver(dark, {0.3f, -2.9f, 0.2f}, {0, 1, 0})));
}

TEST(SensorGrid, AWorkplaneOfARoomWhoseFrontsFaceOutwards) {
  const Scene scene = OutwardRoom{false, true}.scene();
  const RayScene rays(scene);
  const Sensors low = workplane(rays, at_height(0.9, 0.5));
  EXPECT_EQ(floor_level_m(rays, Axis::y), -3);
  EXPECT_EQ(low.left_out, 8u);  // 2 x 2 in either box
  EXPECT_EQ(low.points.size(), 136u);
}

TEST(Sensors, TableAndSummary) {
  Sensors sensors;
  std::vector<Reading> readings;
  for (int i = 0; i < 10000; ++i) {
    sensors.points.push_back({Vec3(static_cast<float>(i), 0.5f, -1), {0, 1, 0}});
    readings.push_back({static_cast<float>(100 + i % 2 * 100), 1.5f, 90, 10});
  }
  std::string all;
  for (const std::string& piece : sensor_csv(sensors, readings)) all += piece;
  EXPECT_TRUE(
      all.starts_with("id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx\n"
                      "0,0,0.5,-1,0,1,0,100,1.5,90,10\n1,1,0.5,-1,0,1,0,200,1.5,90,10\n"));
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 10001);
  EXPECT_TRUE(all.ends_with("\n9999,9999,0.5,-1,0,1,0,200,1.5,90,10\n"));
  const Json summary = summarise(readings);
  EXPECT_EQ(summary.find("number")->as_integer(), 10000);
  EXPECT_EQ(summary.find("mean_lx")->as_number(), 150);
  EXPECT_EQ(summary.find("min_lx")->as_number(), 100);
  EXPECT_EQ(summary.find("max_lx")->as_number(), 200);
  EXPECT_NEAR(summary.find("U0")->as_number(), 2.0 / 3, 1e-6);
  EXPECT_EQ(summary.find("Ud")->as_number(), 0.5);

  sensors.ids.assign(10000, "plain");
  sensors.ids[1] = "a \"b\", c";
  all.clear();
  for (const std::string& piece : sensor_csv(sensors, readings)) all += piece;
  EXPECT_NE(all.find("\nplain,0,"), std::string::npos);
  EXPECT_NE(all.find("\n\"a \"\"b\"\", c\",1,"), std::string::npos);

  EXPECT_EQ(summarise({}).dump(), "{\"number\":0}");
  EXPECT_EQ(summarise(std::vector<Reading>(3)).find("U0"), nullptr);
}

/// A record of a surface says nothing of the air over it.
TEST(SensorCaches, SurfacesServeNoSensorsInTheAir) {
  IrradianceCache cache;
  cache.accuracy = 0.2;
  IrradianceRecord record;
  record.normal = {0, 1, 0}, record.irradiance = Rgb(100), record.radius_m = record.distance_m = 1;
  cache.records.push_back(record);
  SensorCaches caches({}, nullptr);
  caches.add(cache, "memory");
  const auto light = [&](const Vec3& p) { return caches.interpolate(p, {0, 1, 0}); };
  EXPECT_EQ(light({0.3f, 0.05f, 0}).irradiance, Rgb(100));
  for (const float height : {-0.2f, 0.2f, 0.4f}) EXPECT_EQ(light({0, height, 0}).weight, 0) << height;
}

}  // namespace
}  // namespace phos::test
