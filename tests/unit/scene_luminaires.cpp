// What lights send to a point, and with which density.
#include "core/sampling.h"
#include "scene/lamp/luminaires.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/quad.h"

using namespace phos;
using namespace phos::test;

namespace {

/// Irradiance at the origin on a surface facing up, from `count` samples of light 0, cells of a square for u.
double irradiance(const Luminaires& lights, int side) {
  double sum = 0;
  for (int k = 0; k < side * side; ++k) {
    RandomStream random(2, Stage::test, static_cast<std::uint64_t>(k));
    const Vec2 jitter = random.uniform2();
    const Vec2 u((static_cast<float>(k % side) + jitter.x) / static_cast<float>(side),
                 (static_cast<float>(k / side) + jitter.y) / static_cast<float>(side));
    Illumination light;
    if (!lights.illuminate(0, Vec3(0), random.uniform(), u, light)) continue;
    sum += static_cast<double>(light.value.y * light.direction.z / light.density);
  }
  return sum / (side * side);
}

/// Over a parallel rectangle's centre at distance c: four times the corner form factor.
double form_factor(double a, double b, double c) {
  const double x = a / c, y = b / c, sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
  return 4 * (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2 * M_PI);
}

}  // namespace

TEST(AreaLight, GivesTheFormFactorOfARectangle) {
  Scene scene;
  add_lamp(scene, 1, 0.5f, 2, false, Rgb(100));
  const Luminaires lights(scene);
  const double expected = M_PI * 100 * form_factor(1, 0.5, 2);
  EXPECT_NEAR(irradiance(lights, 64), expected, 1e-3 * expected);
}

TEST(AreaLight, AParallelogramKeepsStrata) {
  // Sampled by u alone, 64 x 64 strata are far better than 4096 random points (about 0.2 % here).
  Scene scene;
  add_lamp(scene, 1, 0.5f, 2, false, Rgb(100));
  const Luminaires lights(scene);
  const double expected = M_PI * 100 * form_factor(1, 0.5, 2);
  EXPECT_NEAR(irradiance(lights, 64), expected, 5e-5 * expected);
  // Continuous across the diagonal.
  const EmissionPoint below = lights.sample_point(0, 0.9f, {0.4999f, 0.5f}),
                      above = lights.sample_point(0, 0.1f, {0.5001f, 0.5f});
  EXPECT_NE(below.triangle, above.triangle);
  EXPECT_LT(glm::length(below.position - above.position), 1e-3f);
  EXPECT_EQ(below.density, above.density);
  EXPECT_NEAR(below.density, 0.5f, 1e-6f);
}

TEST(AreaLight, TrianglesOfUnequalPowerAreChosenByIt) {
  Scene scene;
  add_lamp(scene, 1, 0.5f, 2, false, Rgb(100));
  scene.position[3] = Vec3(-3, 0.5f, 2);  // no parallelogram any more
  const Luminaires lights(scene);
  int second = 0;
  for (int k = 0; k < 1000; ++k) {
    second += lights.sample_point(0, (static_cast<float>(k) + 0.5f) / 1000, {0.5f, 0.5f}).triangle == 1;
  }
  const float a0 = area_m2(scene, 0), a1 = area_m2(scene, 1);
  EXPECT_NEAR(static_cast<float>(second) / 1000, a1 / (a0 + a1), 2e-3f);
  EXPECT_NEAR(lights.sample_point(0, 0, {0.5f, 0.5f}).density, 1 / (a0 + a1), 1e-5f);
}

TEST(AreaLight, ShinesFromItsFrontUnlessDoubleSided) {
  Scene scene;
  add_lamp(scene, 1, 1, 2, true, Rgb(7));  // faces away from the origin
  Illumination light;
  EXPECT_FALSE(Luminaires(scene).illuminate(0, Vec3(0), 0.5f, {0.4f, 0.2f}, light));
  EXPECT_TRUE(Luminaires(scene).illuminate(0, Vec3(0, 0, 3), 0.5f, {0.4f, 0.2f}, light));
  EXPECT_EQ(light.value, Rgb(7));
  SurfacePoint point;
  point.front = false;
  EXPECT_EQ(emitted_luminance(scene, point, point.geometric_normal), Rgb(0));
  scene.material[0].double_sided = true;
  EXPECT_TRUE(Luminaires(scene).illuminate(0, Vec3(0), 0.5f, {0.4f, 0.2f}, light));
  EXPECT_EQ(emitted_luminance(scene, point, point.geometric_normal), Rgb(7));
}

TEST(AreaLight, DensityOfAHitIsThatOfTheSample) {
  Scene scene;
  add_lamp(scene, 1, 0.5f, 2, false, Rgb(100));
  add_quad(scene, 5, 5, -1, true, 0);
  const Luminaires lights(scene);
  for (const Vec3& from :
       {Vec3(0.3f, 0.1f, -1), Vec3(0.3f, 0.1f, 0), Vec3(0.3f, 0.1f, 1.99f), Vec3(4, 0, 1.9f)}) {
    for (int k = 0; k < 100; ++k) {
      RandomStream random(3, Stage::test, static_cast<std::uint64_t>(k));
      const Vec2 u = random.uniform2();
      Illumination light;
      ASSERT_TRUE(lights.illuminate(0, from, 0.5f, u, light));
      const std::uint32_t triangle = lights.sample_point(0, 0.5f, u).triangle;
      EXPECT_NEAR(lights.density(0, from, triangle, light.distance_m, light.direction.z), light.density,
                  1e-6f * light.density);
    }
  }
  EXPECT_EQ(lights.light_of(0), 0);
  EXPECT_EQ(lights.light_of(2), -1);
  EXPECT_EQ(lights.density(0, Vec3(0), 2, 1, 1), 0);
}

TEST(AreaLight, NearSamplesWeighAlike) {
  Scene scene;
  add_lamp(scene, 1, 1, 0, false, Rgb(1));
  const Luminaires lights(scene);
  // Close to a corner nearly all of the hemisphere is the lamp's, in solid angle a quarter of it.
  const Vec3 from(0.999f, 0.999f, -1e-3f);
  double most = 0, mean_sr = 0;
  constexpr int kSamples = 4096;
  for (int k = 0; k < kSamples; ++k) {
    Illumination light;
    ASSERT_TRUE(lights.illuminate(0, from, 0, r2_point(k, Vec2(0.5f)), light));
    most = std::max(most, 1 / double(light.density)), mean_sr += 1 / double(light.density) / kSamples;
  }
  const DVec3 corner[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  double seen_sr = 0;  // of a rectangle at a height h: sum of signed atan(x y / (h sqrt(x^2 + y^2 + h^2)))
  for (int i = 0; i < 4; ++i) {
    const DVec3 d = corner[i] - DVec3(from);
    seen_sr += (i % 2 ? -1 : 1) * std::atan(d.x * d.y / (d.z * glm::length(d)));
  }
  EXPECT_NEAR(mean_sr, seen_sr, 1e-3 * seen_sr);
  EXPECT_LT(most, 4 * std::numbers::pi);  // by area: 4e5
}

TEST(AreaLight, ATexturedLampSendsItsWholeFlux) {
  // Left half dark, right half bright; flux by sampling = pi x area x mean luminance.
  Scene scene;
  add_lamp(scene, 1, 0.5f, 2, false, Rgb(100));
  Texture t;
  t.width = 2, t.height = 1;
  t.nearest = true;
  t.texels = {Vec4(0, 0, 0, 1), Vec4(1)};
  scene.texture = {t};
  scene.material[0].emissive.texture = 0;
  const Luminaires lights(scene);
  double sum = 0;
  constexpr int kCount = 20000;
  for (int k = 0; k < kCount; ++k) {
    RandomStream random(4, Stage::test, static_cast<std::uint64_t>(k));
    const float u_triangle = random.uniform();
    const EmissionPoint p = lights.sample_point(0, u_triangle, random.uniform2());
    EXPECT_EQ(p.luminance.x, p.position.x > 0 ? 100.f : 0.f);
    sum += static_cast<double>(p.luminance.x / p.density) / kCount;
  }
  EXPECT_NEAR(sum, 100.0 * 2 / 2, 1.5);
}

TEST(DeltaLights, FollowTheirLaws) {
  Scene scene;
  scene.light.resize(3);
  scene.light[0].kind = Light::Kind::point;
  scene.light[0].position = Vec3(0, 0, 2);
  scene.light[0].intensity = Rgb(8);
  scene.light[1] = scene.light[0];
  scene.light[1].kind = Light::Kind::spot;
  scene.light[1].cos_inner = 0.9f, scene.light[1].cos_outer = 0.5f;
  scene.light[2].kind = Light::Kind::directional;
  scene.light[2].intensity = Rgb(3);
  const Luminaires lights(scene);
  Illumination light;
  ASSERT_TRUE(lights.illuminate(0, Vec3(0), 0, Vec2(0), light));
  EXPECT_EQ(light.value, Rgb(2));
  EXPECT_EQ(light.density, 0);
  EXPECT_EQ(light.direction, Vec3(0, 0, 1));
  EXPECT_FALSE(lights.illuminate(0, Vec3(0, 0, 2), 0, Vec2(0), light));  // at the light itself
  ASSERT_TRUE(lights.illuminate(1, Vec3(0), 0, Vec2(0), light));
  EXPECT_EQ(light.value, Rgb(2));
  EXPECT_FALSE(lights.illuminate(1, Vec3(5, 0, 0), 0, Vec2(0), light));
  EXPECT_FALSE(lights.illuminate(1, Vec3(0, 0, 4), 0, Vec2(0), light));
  ASSERT_TRUE(lights.illuminate(2, Vec3(1e6f), 0, Vec2(0), light));
  EXPECT_EQ(light.value, Rgb(3));
  EXPECT_EQ(light.distance_m, kInfinity);

  Light spot = scene.light[1];
  EXPECT_EQ(spot_falloff(spot, 0.95f), 1);
  EXPECT_NEAR(spot_falloff(spot, 0.7f), 0.25f, 1e-6f);
  EXPECT_EQ(spot_falloff(spot, 0.5f), 0);
  spot.cos_outer = spot.cos_inner;
  EXPECT_EQ(spot_falloff(spot, 0.9f), 1);
  EXPECT_EQ(spot_falloff(spot, 0.8999f), 0);
}

TEST(PowerShares, KeepTheSmallestLamp) {
  Scene scene;
  scene.light.resize(4);
  for (std::size_t i = 0; i < 4; ++i) scene.light[i].flux_lm = Rgb(i == 0 ? 1e6f : 1e-3f);
  const std::vector<double> shares = Luminaires(scene).power_shares(0.2);
  double sum = 0;
  for (const double s : shares) {
    EXPECT_GE(s, 0.05);
    sum += s;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(shares[0], 0.85, 1e-6);
  for (Light& light : scene.light) light.flux_lm = Rgb(0);
  EXPECT_EQ(Luminaires(scene).power_shares(0.2)[2], 0.25);
}
