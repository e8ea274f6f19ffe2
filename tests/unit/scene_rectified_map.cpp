// The environment map through rectangles: what a box of directions holds, and how directions in it are drawn.
#include "scene/opening/rectified_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "scene/opening/portal_light.h"
#include "support/environment.h"

using namespace phos;
using namespace phos::test;

namespace {

const RectifiedMap::Axes kAlongZ{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}};

/// A window of 2 x 1.5 m in the plane z = 3, seen from the origin: its corners.
const DVec3 kCorner(-0.4, -0.2, 3), kOpposite(1.6, 1.3, 3);

/// Solid angle of a rectangle from one corner's foot, by the closed form.
double corner_sr(double u, double v) { return std::atan2(u * v, std::sqrt(1 + u * u + v * v)); }

double window_sr() {
  const double u[2] = {kCorner.x / 3, kOpposite.x / 3}, v[2] = {kCorner.y / 3, kOpposite.y / 3};
  return corner_sr(u[1], v[1]) - corner_sr(u[0], v[1]) - corner_sr(u[1], v[0]) + corner_sr(u[0], v[0]);
}

/// A sky that is three times as bright in the zenith as at the horizon (CIE overcast), dark below.
Environment overcast() {
  return map_of(256, [](int, int row) {
    const double sine = std::cos((row + 0.5) / 256 * std::numbers::pi);
    return Rgb(sine > 0 ? static_cast<float>(1000 * (1 + 2 * sine)) : 0.f);
  });
}

}  // namespace

TEST(RectifiedMap, EvenLightIsTheSolidAngle) {
  const Environment light = constant_map(16, Rgb(250));
  const RectifiedMap map(light, kAlongZ);
  // Light is linear within cells of a third of a degree.
  EXPECT_NEAR(map.light_lx(map.box(kCorner, kOpposite)) / (250 * window_sr()), 1, 2e-5);
  EXPECT_EQ(map.light_lx(map.box(-kCorner, -kOpposite)), 0) << "from behind";
  EXPECT_EQ(map.light_lx(map.box({-1, -1, 0}, {1, 1, 0})), 0) << "from its plane";
  // All before the plane: half the sphere.
  EXPECT_NEAR(map.light_lx(map.box({-1e9, -1e9, 1}, {1e9, 1e9, 1})) / (250 * 2 * std::numbers::pi), 1, 1e-6);
}

TEST(RectifiedMap, DirectionsAreDrawnAsTheirDensitySays) {
  const Environment light = overcast();
  const RectifiedMap map(light, kAlongZ);
  const RectifiedMap::Box box = map.box(kCorner, kOpposite);
  const double light_lx = map.light_lx(box);
  RandomStream random(7, Stage::pilot, 0);
  // The mean of 1 / density over drawn directions is the solid angle, of luminance / density the light.
  double sr = 0, lx = 0, square = 0;
  constexpr int kDraws = 200'000;
  for (int k = 0; k < kDraws; ++k) {
    const Vec3 d = map.sample(box, random.uniform2());
    const double u = static_cast<double>(d.x / d.z), v = static_cast<double>(d.y / d.z);
    ASSERT_GE(3 * u, kCorner.x - 1e-5);
    ASSERT_LE(3 * u, kOpposite.x + 1e-5);
    ASSERT_GE(3 * v, kCorner.y - 1e-5);
    ASSERT_LE(3 * v, kOpposite.y + 1e-5);
    const double density = map.density(light_lx, d);
    const double found = static_cast<double>(light.map_luminance(d).x) / density;
    sr += 1 / density / kDraws, lx += found / kDraws, square += found * found / kDraws;
  }
  EXPECT_NEAR(sr, window_sr(), 0.004 * window_sr());
  EXPECT_NEAR(lx / light_lx, 1, 0.003);
  // As even as the table is fine: the map has steps of .7 degrees, and half of this window shows dark ground.
  EXPECT_LT(std::sqrt(square / (lx * lx) - 1), 0.25);
}

/// A spot counts as four times the mean: who looks for it looks elsewhere too, should it be hidden.
TEST(RectifiedMap, SpotsDoNotRule) {
  const int row = 500, column = 1010;
  const Environment light =
      map_of(2048, [&](int x, int y) { return Rgb(x == column && y == row ? 1e9f : 1.f); });
  const RectifiedMap map(light, kAlongZ);
  const double mean = light.map_lx() / (4 * std::numbers::pi);
  const RectifiedMap::Box all = map.box({-1e9, -1e9, 1}, {1e9, 1e9, 1});
  EXPECT_LT(map.light_lx(all), 2 * std::numbers::pi * 4 * mean * 1.001);
  EXPECT_GT(map.light_lx(all), 0);
}

/// One ray through a window of a room sees nearly the same light as another, by a sky that is not even.
TEST(RectifiedMap, PortalsDrawByTheLightBehind) {
  const Environment light = overcast();
  Portal window;
  window.corner = Vec3(-0.4f, 0.2f, 3), window.edge[0] = Vec3(2, 0, 0), window.edge[1] = Vec3(0, 1.5f, 0);
  window.inwards = Vec3(0, 0, -1);
  const PortalLight portals(light, std::span(&window, 1), nullptr);
  RandomStream random(3, Stage::pilot, 1);
  double mean = 0, square = 0, sr = 0;
  constexpr int kDraws = 100'000;
  for (int k = 0; k < kDraws; ++k) {
    const Environment::Sample s = portals.sample(Vec3(0), random.uniform2());
    if (!(s.density > 0)) continue;
    ASSERT_NEAR(portals.density(Vec3(0), s.direction) / s.density, 1, 2e-3);
    const double t = 3 / static_cast<double>(s.direction.z), x = t * static_cast<double>(s.direction.x),
                 y = t * static_cast<double>(s.direction.y);
    const bool seen = s.direction.z > 0 && x > -0.4 && x < 1.6 && y > 0.2 && y < 1.7;
    const double found = seen ? static_cast<double>(s.luminance.x / s.density) : 0;
    sr += seen ? 1 / static_cast<double>(s.density) / kDraws : 0;
    mean += found / kDraws, square += found * found / kDraws;
  }
  const double u[2] = {-0.4 / 3, 1.6 / 3}, v[2] = {0.2 / 3, 1.7 / 3};
  EXPECT_NEAR(
      sr / (corner_sr(u[1], v[1]) - corner_sr(u[0], v[1]) - corner_sr(u[1], v[0]) + corner_sr(u[0], v[0])), 1,
      0.01);
  // One ray in ten goes elsewhere: .33 of the mean is what they make of it.
  EXPECT_LT(std::sqrt(square / (mean * mean) - 1), 0.37);
}
