// Light straight from the lamps: closed forms, what stands in the way, and the error that it states.
#include <gtest/gtest.h>

#include "direct/direct_light.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

constexpr double kPiD = std::numbers::pi;

DirectIrradiance direct_at(const Scene& scene, const Vec3& p, const Vec3& n, int samples,
                           std::uint64_t item = 0) {
  const RayScene rays(scene);
  const Luminaires lights(scene);
  RandomStream random(3, Stage::direct_light, item);
  return direct_irradiance(rays, lights, receiver(scene, p, n), samples, random);
}

TEST(DirectLight, APointLampOverAFloorIsExactAtEverySize) {
  const AnalyticScene metre = point_light_over_plane(2, 100, 0);
  for (const float size : {1e-6f, 1e-3f, 1.f, 1e3f, 1e6f}) {
    const AnalyticScene s = scaled(metre, size);
    for (const Check& check : s.checks) {
      const DirectIrradiance e = direct_at(s.scene, check.position, check.normal, 1);
      EXPECT_NEAR(e.irradiance.y / check.irradiance_lx, 1, 1e-4) << s.name;
      EXPECT_EQ(e.stderr_lx, Rgb(0));
    }
  }
}

/// 4096 low-discrepancy samples are far better than their own standard error, which is on the high side.
TEST(DirectLight, RectanglesAreWithinTheirError) {
  for (const AnalyticScene& metre : {rectangle_light_parallel(), rectangle_light_perpendicular()}) {
    for (const float size : {1e-6f, 1.f, 1e6f}) {
      const AnalyticScene s = scaled(metre, size);
      for (const Check& check : s.checks) {
        const DirectIrradiance e = direct_at(s.scene, check.position, check.normal, 4096);
        EXPECT_NEAR(e.irradiance.y, check.irradiance_lx, 2e-3 * check.irradiance_lx) << s.name;
        EXPECT_LT(std::abs(double(e.irradiance.y) - check.irradiance_lx), 2 * double(e.stderr_lx.y));
        EXPECT_GT(e.stderr_lx.y, 0);
      }
    }
  }
}

/// A room that glows: E = pi L, and the stated error bounds what repeats show, at any number of samples.
TEST(DirectLight, TheStatedErrorIsAnUpperBound) {
  const AnalyticScene s = emitting_environment(100);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  for (const int samples : {2, 16, 256}) {
    double sum = 0, square = 0, stated = 0;
    constexpr int kRepeats = 200;
    for (std::uint64_t k = 0; k < kRepeats; ++k) {
      RandomStream random(5, Stage::direct_light, k);
      const DirectIrradiance e = direct_irradiance(
          rays, lights, receiver(s.scene, s.checks[0].position, s.checks[0].normal), samples, random);
      sum += double(e.irradiance.y), square += double(e.irradiance.y) * double(e.irradiance.y);
      stated += double(e.stderr_lx.y) * double(e.stderr_lx.y);
    }
    const double mean = sum / kRepeats, spread = std::sqrt(square / kRepeats - mean * mean);
    stated = std::sqrt(stated / kRepeats);
    EXPECT_NEAR(mean, 100 * kPiD, 4 * spread / std::sqrt(kRepeats)) << samples;
    EXPECT_LT(spread, 1.2 * stated) << samples;
  }
}

TEST(DirectLight, NothingShinesThroughSurfacesOrFromBehind) {
  for (const AnalyticScene& s : {thin_walls(), two_sided_sheet(1000, 10)}) {
    for (const Check& check : s.checks) {
      const DirectIrradiance e = direct_at(s.scene, check.position, check.normal, 1);
      EXPECT_NEAR(double(e.irradiance.y), check.irradiance_lx, 1e-4 * check.irradiance_lx) << s.name;
    }
  }
}

TEST(DirectLight, TheSunNeedsOneSampleAndCastsShadows) {
  Scene scene;
  const std::uint32_t grey = add_lambert(scene, "grey", 0.5f);
  begin_instance(scene, "floor", grey);
  add_quad(scene, {-5, 0, -5}, {0, 0, 10}, {10, 0, 0});
  begin_instance(scene, "awning", grey);
  add_quad(scene, {0, 1, -5}, {0, 0, 10}, {5, 0, 0});
  Light sun;
  sun.kind = Light::Kind::directional;
  sun.direction = glm::normalize(Vec3(0, -2, 1));
  sun.intensity = Rgb(5e4f);
  scene.light.push_back(sun);
  finalize(scene);
  EXPECT_NEAR(direct_at(scene, {-1, 0, 0}, {0, 1, 0}, 64).irradiance.y, 5e4 * 2 / std::sqrt(5), 1);
  EXPECT_EQ(direct_at(scene, {1, 0, 0}, {0, 1, 0}, 64).irradiance, Rgb(0));
}

TEST(DirectLight, SamplesSayWhereTheLampIs) {
  const AnalyticScene s = rectangle_light_parallel(2, 3, 1.5f);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  RandomStream random(1, Stage::direct_light, 0);
  std::vector<LampSample> lamps(7);
  const Vec3 p(0.5f, 0, 1);
  sample_lamps(rays, lights, receiver(s.scene, p, {0, 1, 0}), 64, random, lamps);
  ASSERT_EQ(lamps.size(), 64u);
  const Vec3 half[] = {{0, 1.5f, 0}, {2, 1.5f, 0}, {2, 1.5f, 3}}, other[] = {half[2], {0, 1.5f, 3}, half[0]};
  const double seen_sr =
      SphericalTriangle(half, p).solid_angle_sr() + SphericalTriangle(other, p).solid_angle_sr();
  for (const LampSample& lamp : lamps) {
    const Vec3 at = p + lamp.distance_m * lamp.direction;
    EXPECT_NEAR(at.y, 1.5f, 1e-5);
    EXPECT_TRUE(at.x >= -1e-5f && at.x <= 2 + 1e-5f && at.z >= -1e-5f && at.z <= 3 + 1e-5f);
    EXPECT_EQ(lamp.normal, Vec3(0, -1, 0));
    EXPECT_EQ(lamp.light, 0u);
    // Its share of what is near: L cos / n times the solid angle.
    EXPECT_NEAR(double(lamp.irradiance.y), 1000 * double(lamp.direction.y) / 64 * seen_sr, 1e-3);
  }
  sample_lamps(rays, lights, receiver(s.scene, p, {0, -1, 0}), 64, random, lamps);
  EXPECT_TRUE(lamps.empty());
}

/// Receivers all over a tilted room far from the origin are not shaded by the walls that they are on.
TEST(DirectLight, ASurfaceDoesNotShadeItself) {
  AnalyticScene s = furnace(0.5f, 10);
  const Mat4 turn = glm::translate(Mat4(1), Vec3(300, -500, 70)) *
                    glm::rotate(Mat4(1), 0.7f, glm::normalize(Vec3(1, 2, 3)));
  for (Vec3& p : s.scene.position) p = Vec3(turn * Vec4(p, 1));
  for (Vec3& n : s.scene.normal) n = Vec3(turn * Vec4(n, 0));
  s.scene.light.clear();
  s.scene.bounds = {};
  finalize(s.scene);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  std::vector<LampSample> lamps;
  for (const Check& check : s.checks) {
    const Vec3 p(turn * Vec4(check.position, 1)), n(turn * Vec4(check.normal, 0));
    RandomStream random(1, Stage::direct_light, 0);
    const Rgb e = direct_irradiance(rays, lights, receiver(s.scene, p, n), 4096, random).irradiance;
    EXPECT_NEAR(e.y, 10 * kPiD, 0.04 * 10 * kPiD);
  }
}

}  // namespace
}  // namespace phos::test
