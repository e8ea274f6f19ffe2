// Light straight through panes and off flat mirrors, by path tracing, against closed forms.
#include <gtest/gtest.h>

#include "reference/point_irradiance.h"
#include "support/daylight.h"
#include "support/panes.h"

namespace phos::test {
namespace {

PointIrradiance exact(const Scene& scene, const Vec3& p, std::int64_t samples, const Vec3& n = {0, 1, 0}) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  return estimate_irradiance(rays, lights, p, n, samples);
}

}  // namespace

TEST(Panes, SunAndLampThroughOne) {
  Scene scene = under_a_pane(1);
  surround(scene, sky_of("", "180,60", 0, 100000));
  const double truth = 1e5 * std::sin(glm::radians(60.0)) * kAt30;
  const PointIrradiance e = exact(scene, {0, 0.2f, 0}, 1024);
  EXPECT_NEAR(e.illuminance_lx, truth, 0.01 * truth);
  EXPECT_LT(e.illuminance_stderr_lx, 0.02 * truth);

  scene = under_a_pane(1);
  add_point_light(scene, {0, 2, 0}, 1000);
  finalize(scene);
  EXPECT_NEAR(exact(scene, {0, 0.5f, 0}, 64).illuminance_lx, 1000 / 2.25 * kClear, 0.02);
}

/// A floor of albedo k under an endless lossless pane, a uniform sky L above: between floor and pane light
/// goes to and fro, E = pi L T / (1 - k (1 - T)), T = 0.850938 of diffuse light.
TEST(Panes, InterreflectionUnderOne) {
  constexpr double kDiffuse = 0.850938301, kAlbedo = 0.5, kLuminance = 100;
  Scene scene = under_a_pane(0.05f, kAlbedo);
  surround(scene, Environment(2, 1, std::vector<Rgb>(2, Rgb(kLuminance))));
  const double truth = std::numbers::pi * kLuminance * kDiffuse / (1 - kAlbedo * (1 - kDiffuse));
  const PointIrradiance e = exact(scene, {0, 0, 0}, 20000);
  EXPECT_NEAR(e.illuminance_lx, truth, 3 * e.illuminance_stderr_lx + 0.003 * truth);
  EXPECT_LT(e.illuminance_stderr_lx, 0.01 * truth);
}

/// Walls of a shining room and a pane in it: pi L / (1 - k) everywhere.
TEST(Panes, FurnaceWithOne) {
  Scene scene;
  begin_instance(scene, "room", add_lambert(scene, "room", 0.5f, 100));
  add_room(scene, {-1, 0, -1}, {1, 2, 1});
  begin_instance(scene, "pane", add_pane(scene));
  add_quad(scene, {-1, 0.7f, -1}, {0, 0, 2}, {2, 0, 0});
  finalize(scene);
  for (const float y : {0.f, 0.6f, 0.8f}) {
    const PointIrradiance e = exact(scene, {0.2f, y, 0.1f}, 4000);
    EXPECT_NEAR(e.illuminance_lx, std::numbers::pi * 200, 4 * e.illuminance_stderr_lx) << y;
    EXPECT_LT(e.illuminance_stderr_lx, 0.02 * e.illuminance_lx) << y;
  }
}

namespace {

/// A black box of 4 m with mirrors, and a point lamp or a small square one at (1.5, 2.5, 2).
Scene mirror_box(bool square, const std::vector<int>& mirrors, float reflectance) {
  Scene scene;
  const std::uint32_t black = add_lambert(scene, "black", 0), mirror = add_lambert(scene, "mirror", 0);
  scene.material[mirror].model = Model::mirror, scene.material[mirror].ks = Rgb(reflectance);
  const Vec3 x(4, 0, 0), y(0, 4, 0), z(0, 0, 4), o(0);
  const Vec3 wall[6][3] = {{o, z, x}, {o + y, x, z}, {o, y, z}, {o + x, z, y}, {o, x, y}, {o + z, y, x}};
  for (int w = 0; w < 6; ++w) {
    const bool is_mirror = std::find(mirrors.begin(), mirrors.end(), w) != mirrors.end();
    begin_instance(scene, "wall", is_mirror ? mirror : black);
    add_quad(scene, wall[w][0], wall[w][1], wall[w][2]);
  }
  if (square) {
    begin_instance(scene, "lamp", add_lambert(scene, "lamp", 0, 1e5f));
    add_quad(scene, {1.45f, 2.5f, 1.95f}, {0.1f, 0, 0}, {0, 0, 0.1f});  // down
  } else {
    add_point_light(scene, {1.5f, 2.5f, 2}, 1000);
  }
  finalize(scene);
  return scene;
}

/// Of a point lamp of 1000 cd at `lamp`, on a sensor that faces up.
double lx(const DVec3& lamp, const DVec3& p) {
  const DVec3 way = lamp - p;
  const double d = glm::length(way);
  return way.y > 0 ? 1000 * way.y / (d * d * d) : 0;
}

}  // namespace

/// The image of the lamp at 2 x 4 - 1.5 = 6.5 m.
TEST(Mirrors, AWallOfMirrorIsAnImage) {
  for (const Vec3& p : {Vec3(0.5f, 0, 0.5f), Vec3(3.5f, 0, 2), Vec3(2.5f, 1.2f, 2.5f)}) {
    const double truth = lx({1.5, 2.5, 2}, DVec3(p)) + 0.9 * lx({6.5, 2.5, 2}, DVec3(p));
    const PointIrradiance e = exact(mirror_box(false, {3}, 0.9f), p, 64);
    EXPECT_NEAR(e.illuminance_lx, truth, 1e-3 * truth);
  }
}

/// Between mirrors at x = 0 and x = 4, at 8 m + 1.5 and 8 m - 1.5.
TEST(Mirrors, BetweenTwoOfThem) {
  const DVec3 p(2, 0, 2);
  double truth = 0;
  for (int m = -40; m <= 40; ++m) {
    truth += std::pow(0.9, 2 * std::abs(m)) * lx({8.0 * m + 1.5, 2.5, 2}, p);
    truth += std::pow(0.9, m >= 1 ? 2 * m - 1 : 2 * std::abs(m) + 1) * lx({8.0 * m - 1.5, 2.5, 2}, p);
  }
  EXPECT_NEAR(exact(mirror_box(false, {2, 3}, 0.9f), Vec3(p), 64).illuminance_lx, truth, 5e-3 * truth);
}

/// Of an area lamp both the image and the paths that hit the lamp by way of the mirror count, weighted: once.
TEST(Mirrors, AnAreaLampIsCountedOnce) {
  const Vec3 p(2, 0, 2);
  const Scene one = mirror_box(true, {3}, 1), none = mirror_box(true, {}, 1);
  // I cos cos / d2 of the lamp, 1000 cd along its normal, and of its image; it is small.
  const double truth = 1000 * 2.5 * 2.5 * (1 / std::pow(6.5, 2) + 1 / std::pow(26.5, 2));
  const PointIrradiance e = exact(one, p, 20000);
  EXPECT_NEAR(e.illuminance_lx, truth, 0.005 * truth);
  EXPECT_GT(e.illuminance_lx, 1.05 * exact(none, p, 4096).illuminance_lx);
}

}  // namespace phos::test
