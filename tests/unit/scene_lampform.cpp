// The closed form of a lamp's light against the form factors of rectangles, and against its samples.
#include <gtest/gtest.h>

#include "core/random.h"
#include "core/sampling.h"
#include "scene/lamp/form.h"
#include "scene/lamp/luminaires.h"
#include "scene/load.h"

using namespace phos;

namespace {

/// a x b at height c, one corner over the origin, shining down.
std::vector<DVec3> ceiling(double a, double b, double c) {
  return {{0, 0, c}, {0, b, c}, {a, b, c}, {a, 0, c}};
}

}  // namespace

TEST(ProjectedSolidAngle, IsThatOfAParallelRectangle) {
  const double pi = std::numbers::pi;
  for (const auto [a, b, c] :
       {std::array{1.0, 1.0, 1.0}, {3.0, 0.5, 0.2}, {1e-3, 2e-3, 1.0}, {1e6, 1e6, 1e3}}) {
    const double x = a / c, y = b / c;
    const double exact = 0.5 * (x / std::hypot(1, x) * std::atan(y / std::hypot(1, x)) +
                                y / std::hypot(1, y) * std::atan(x / std::hypot(1, y)));
    EXPECT_NEAR(projected_solid_angle(ceiling(a, b, c), {0, 0, 1}), exact, 1e-9 * exact) << a << " " << b;
    EXPECT_LE(exact, pi);
  }
}

TEST(ProjectedSolidAngle, IsThePartAboveTheHorizon) {
  // A wall that stands half below the ground is as good as its upper half.
  const std::vector<DVec3> whole{{1, -1, -2}, {1, 1, -2}, {1, 1, 2}, {1, -1, 2}};
  const std::vector<DVec3> half{{1, -1, 0}, {1, 1, 0}, {1, 1, 2}, {1, -1, 2}};
  const double e = projected_solid_angle(half, {0, 0, 1});
  EXPECT_GT(std::fabs(e), 0.1);
  EXPECT_NEAR(projected_solid_angle(whole, {0, 0, 1}), e, 1e-14);
  EXPECT_EQ(projected_solid_angle(ceiling(1, 1, 1), {0, 0, -1}), 0);
}

TEST(ProjectedSolidAngle, ChangesSignSeenFromBehindAndSurvivesItsLimits) {
  std::vector<DVec3> lamp = ceiling(1, 1, 1);
  const double e = projected_solid_angle(lamp, {0, 0, 1});
  EXPECT_GT(e, 0);
  std::reverse(lamp.begin(), lamp.end());
  EXPECT_DOUBLE_EQ(projected_solid_angle(lamp, {0, 0, 1}), -e);
  EXPECT_EQ(projected_solid_angle(ceiling(1, 1, 0), {0, 0, 1}), 0) << "in its plane, at a corner";
  EXPECT_EQ(projected_solid_angle(ceiling(0, 0, 1), {0, 0, 1}), 0) << "no area";
  const std::vector<DVec3> tiny = ceiling(1e-9, 1e-9, 1);
  EXPECT_NEAR(projected_solid_angle(tiny, {0, 0, 1}), 1e-18, 1e-24);
}

TEST(ProjectedSolidAngle, IsRightForEdgesOfEveryLength) {
  // A narrow strip from 45 degrees to one side to `far` on the other, straight above: two long edges.
  const double width = 1e-3;
  for (double far = -44.5; far < 90; far += 0.5) {
    const double x = std::tan(far * std::numbers::pi / 180);
    const std::vector<DVec3> strip{{-1, 0, 1}, {-1, width, 1}, {x, width, 1}, {x, 0, 1}};
    const auto edge = [&](double b) {  // of a rectangle 0 .. b by 0 .. width
      return 0.5 * (b / std::hypot(1, b) * std::atan(width / std::hypot(1, b)) +
                    width / std::hypot(1, width) * std::atan(b / std::hypot(1, width)));
    };
    const double exact = edge(x) + edge(1);
    EXPECT_NEAR(projected_solid_angle(strip, {0, 0, 1}), exact, 1e-9 * exact) << far;
  }
}

TEST(LampForm, TakesTwoTrianglesForTheParallelogramThatTheyAre) {
  const Scene scene = load_scene(std::string(PHOS_SOURCE) + "/data/cornell-measured.glb");
  const LampPanel panel(scene, scene.light[0]);
  ASSERT_EQ(panel.patches().size(), 1u);
  EXPECT_TRUE(panel.patches()[0].parallelogram);
  const Instance& lamp = scene.instance[scene.light[0].instance];
  ASSERT_EQ(lamp.triangle_count, 2u);
  const Vec3 p = scene.bounds.centre(), n(0, 1, 0);
  double halves = 0;
  for (std::uint32_t t = lamp.first_triangle; t < lamp.first_triangle + 2; ++t) {
    std::vector<DVec3> corner;
    for (const std::uint32_t v : scene.triangle[t].v) corner.push_back(DVec3(scene.position[v]) - DVec3(p));
    halves += projected_solid_angle(corner, DVec3(n));
  }
  EXPECT_GT(halves, 0.01);
  EXPECT_NEAR(static_cast<double>(LampForm(panel).projected_solid_angle(p, n)), halves, 1e-6 * halves);
}

TEST(LampForm, IsTheMeanOfTheLampsSamples) {
  const Scene scene = load_scene(std::string(PHOS_SOURCE) + "/data/cornell-measured.glb");
  const Luminaires lights(scene);
  const LampForm form(scene, scene.light[0]);
  ASSERT_TRUE(form.closed());
  RandomStream random(0, Stage::test, 0);
  for (int i = 0; i < 20; ++i) {
    const Vec3 u(random.uniform(), random.uniform(), random.uniform());
    const Vec3 p = scene.bounds.lo + u * scene.bounds.size();
    const Vec3 n = sample_uniform_sphere(random.uniform2());
    double sum = 0;
    const int samples = 4000;
    for (int s = 0; s < samples; ++s) {
      Illumination light;
      if (!lights.illuminate(0, p, random.uniform(), random.uniform2(), light)) continue;
      sum += std::max(0.f, glm::dot(n, light.direction)) / light.density;
    }
    const double exact = form.projected_solid_angle(p, n);
    EXPECT_NEAR(sum / samples, exact, 0.05 * exact + 1e-4) << i;
  }
}

TEST(LampForm, IsNotThereForLampsOfManyColoursOrManyTriangles) {
  Scene scene = load_scene(std::string(PHOS_SOURCE) + "/data/cornell-measured.glb");
  Light sun;
  sun.kind = Light::Kind::directional;
  EXPECT_FALSE(LampForm(scene, sun).closed());
  const Light lamp = scene.light[0];
  scene.material[scene.instance[lamp.instance].material].emissive.texture = 0;
  EXPECT_FALSE(LampForm(scene, lamp).closed());
}
