// Leaks: what a record tells of places that it cannot see, with the leak test and without; and that the test
// does not take flat or gently curved surfaces for walls.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "record/in_sight.h"
#include "record/irradiance_cache.h"
#include "record/tree.h"
#include "scene/rays.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

IrradianceRecord record_at(const Vec3& p, const Vec3& n, double irradiance_lx, float radius_m) {
  IrradianceRecord r;
  r.position = p, r.normal = n;
  r.irradiance = Rgb(static_cast<float>(irradiance_lx));
  r.radius_m = r.distance_m = radius_m;
  return r;
}

Vec2 random_in(RandomStream& random, float half) {
  const Vec2 u = random.uniform2();
  return {half * (2 * u.x - 1), half * (2 * u.y - 1)};
}

/// Of the light that records on the lit wall receive, the share that lookups on dark faces say is there.
/// `everywhere`: dark faces have records of their own, too.
double leak(const AnalyticScene& s, float gap_m, bool everywhere, bool leak_test, float radius_m) {
  const RayScene rays(s.scene);
  RecordTree tree(s.scene.bounds, 0.3, leak_test ? &rays : nullptr);
  RandomStream random(11, Stage::test, 0);
  for (int i = 0; i < 200; ++i) {
    const Vec2 q = random_in(random, 1.9f);
    for (const float z : {0.f, -gap_m}) {
      for (const float side : {1.f, -1.f}) {
        const Vec3 p(q, z), n(0, 0, side);
        if (everywhere || s.irradiance_lx(p, n) > 0)
          tree.insert(record_at(p, n, s.irradiance_lx(p, n), radius_m));
      }
    }
  }
  double lit = 0, dark = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec2 q = random_in(random, 1.9f);
    lit += double(tree.interpolate({q, 0}, {0, 0, 1}).irradiance.y);
    for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0, 0, -1)})
      dark += double(tree.interpolate({q, -gap_m}, n).irradiance.y);
    dark += double(tree.interpolate({q, 0}, {0, 0, -1}).irradiance.y);
  }
  EXPECT_GT(lit, 0);
  return dark / lit;
}

/// With radii of a metre or more, rounding tolerance of the in-front test (a hundredth of the radius) lets
/// light through a gap of a centimetre; the ray does not.
TEST(Leaks, ThinWallsLeakNothingWithTheRay) {
  for (const float gap_m : {0.01f, 0.001f}) {
    const AnalyticScene s = thin_walls(1000, gap_m);
    for (const bool everywhere : {false, true}) {
      EXPECT_GT(leak(s, gap_m, everywhere, false, 3), 0.1) << "no leak to mend: the test shows nothing";
      EXPECT_LT(leak(s, gap_m, everywhere, true, 3), 1e-3) << gap_m;
    }
    EXPECT_LT(leak(s, gap_m, true, true, 0.3f), 1e-3) << gap_m;
  }
}

TEST(Leaks, TheSameAtEverySize) {
  for (const float size : {1e-6f, 1e6f}) {
    const AnalyticScene s = scaled(thin_walls(1000, 0.01f), size);
    const RayScene rays(s.scene);
    const Vec3 up(0, 0, 1);
    const IrradianceRecord lit = record_at(Vec3(0), up, 1000, 3 * size);
    const Vec3 behind = size * Vec3(0.1f, 0.05f, -0.01f), beside = size * Vec3(0.1f, 0.05f, 0);
    EXPECT_FALSE(record_apart(lit, behind, up));
    EXPECT_FALSE(record_in_sight(rays, lit, behind, up));
    EXPECT_TRUE(record_in_sight(rays, lit, beside, up));
  }
}

/// Records of which a place takes the heaviest, as it does in dense grids, and farther ones where a wall
/// hides those.
TEST(Leaks, OfManyRecordsTheHeaviestInSightServe) {
  const AnalyticScene s = thin_walls(1000, 0.01f);
  const RayScene rays(s.scene);
  const Vec3 up(0, 0, 1), place(0);
  RecordTree tree(s.scene.bounds, 0.3, &rays);
  RandomStream random(3, Stage::test, 0);
  std::vector<std::pair<float, float>> light_of;  // weight, light
  for (int i = 0; i < 3000; ++i) {
    const IrradianceRecord r =
        record_at(Vec3(random_in(random, 0.5f), 0), up, 100 * static_cast<double>(random.uniform()), 3);
    light_of.emplace_back(record_weight(record_error(r, place, up), 0.3f), r.irradiance.y);
    tree.insert(r);
  }
  std::sort(light_of.rbegin(), light_of.rend());
  double weight = 0, light = 0;
  for (std::size_t i = 0; i < kMostInSight; ++i)
    weight += double(light_of[i].first), light += double(light_of[i].first * light_of[i].second);
  const auto light_at = [&](const Vec3& p) {
    Interpolated sum;
    tree.add_few(p, up, sum, kInfinity);
    sum.finish();
    return sum;
  };
  EXPECT_NEAR(double(light_at(place).irradiance.y), light / weight, 1e-3 * light / weight);
  // Behind the wall all of these are hidden, and one farther off is not.
  const Vec3 behind(0, 0, -0.01f);
  EXPECT_EQ(light_at(behind).weight, 0);
  tree.insert(record_at({0.6f, 0, -0.01f}, up, 7, 3));
  EXPECT_NEAR(double(light_at(behind).irradiance.y), 7, 1e-5);
}

/// Share of the pairs of points that could serve each other but for the ray.
double lost(const Scene& scene, float radius_m, bool smooth) {
  const RayScene rays(scene);
  struct Place {
    Vec3 p, n;
  };
  std::vector<Place> places;
  RandomStream random(5, Stage::test, 1);
  for (int i = 0; i < 1500; ++i) {
    const auto t = static_cast<std::uint32_t>(random.uniform() * static_cast<float>(scene.triangle.size()));
    const Vec2 w = random.uniform2();
    const Vec2 b = w.x + w.y > 1 ? Vec2(1) - w : w;
    Vec3 p(0), n(0);
    const float weight[3] = {1 - b.x - b.y, b.x, b.y};
    for (std::size_t c = 0; c < 3; ++c) {
      p += weight[c] * scene.position[scene.triangle[t].v[c]];
      n += weight[c] * scene.normal[scene.triangle[t].v[c]];
    }
    places.push_back({p, smooth ? glm::normalize(n) : geometric_normal(scene, t)});
  }
  std::size_t pairs = 0, hidden = 0;
  for (const Place& a : places) {
    const IrradianceRecord r = record_at(a.p, a.n, 1, radius_m);
    for (const Place& b : places) {
      if (!(record_weight(record_error(r, b.p, b.n), 0.3f) > kLeastWeight)) continue;
      if (record_apart(r, b.p, b.n)) continue;
      ++pairs;
      hidden += !record_in_sight(rays, r, b.p, b.n);
    }
  }
  EXPECT_GT(pairs, 5000u);
  return static_cast<double>(hidden) / static_cast<double>(pairs);
}

/// Turned and moved far off, so that coordinates are rounded.
Scene moved(Scene scene) {
  const Mat4 turn =
      glm::translate(Mat4(1), Vec3(30, -50, 7)) * glm::rotate(Mat4(1), 0.7f, glm::normalize(Vec3(1, 2, 3)));
  for (Vec3& p : scene.position) p = Vec3(turn * Vec4(p, 1));
  for (Vec3& n : scene.normal) n = Vec3(turn * Vec4(n, 0));
  for (Light& light : scene.light) light.position = Vec3(turn * Vec4(light.position, 1));
  scene.bounds = {};
  finalize(scene);
  return scene;
}

TEST(Leaks, AFlatFloorOfManyPiecesHidesNothing) {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "grey", 0.5f));
  for (int i = 0; i < 40; ++i)
    for (int k = 0; k < 40; ++k) add_quad(scene, 0.25f * Vec3(i, 0, k), {0, 0, 0.25f}, {0.25f, 0, 0});
  finalize(scene);
  EXPECT_EQ(lost(moved(scene), 3, false), 0);
}

/// A ball seen from outside: smooth normals, then flat facets.
TEST(Leaks, ABallHidesLittleOfItself) {
  for (const int triangles : {320, 1280, 20480}) {
    Scene ball = integrating_sphere(0.5f, triangles).scene;
    for (Triangle& t : ball.triangle) std::swap(t.v[1], t.v[2]);
    for (std::size_t i = 0; i < ball.position.size(); ++i) ball.normal[i] = glm::normalize(ball.position[i]);
    for (const bool smooth : {true, false}) {
      EXPECT_LT(lost(moved(ball), 1, smooth), 0.01) << triangles << (smooth ? " smooth" : " flat");
    }
  }
}

}  // namespace
}  // namespace phos::test
