// Direct light of measured luminaires at visible points: shadow rays, shared ones, and shadow maps.
#include <gtest/gtest.h>

#include "direct/direct_light.h"
#include "estimate/shading.h"
#include "record/tree.h"
#include "splat/direct/interleaved.h"
#include "splat/gl/renderer.h"
#include "support/luminaires.h"
#include "support/splat_scenes.h"

namespace phos::test {
namespace {

constexpr int kSide = 48;

TEST(MeasuredPicture, ShadowRaysAgreeWithTheClosedForm) {
  for (const AnalyticScene& s : luminaire_scenes()) {
    const RayScene rays(s.scene);
    const Luminaires lights(s.scene);
    const RecordTree no_records(s.scene.bounds, 0.2);
    const Shading shading(rays, lights, no_records, {});
    for (const Check& check : s.checks) {
      SurfacePoint point;
      ASSERT_TRUE(trace(rays, {check.position + 0.004f * check.normal, -check.normal}, point)) << s.name;
      RandomStream random(1, Stage::test, 0);
      const DirectLight light = shading.direct(point, Bsdf(s.scene, point), check.normal, 4096, 0, random);
      EXPECT_NEAR(light.illuminance.y, check.irradiance_lx, 2e-3 * check.irradiance_lx) << s.name;
    }
  }
}

void expect_agreement(const AnalyticScene& s, const GBuffer& gbuffer, const std::vector<double>& value) {
  const Agreement a = compare(s, gbuffer, value, std::vector<double>(value.size(), 0), 0.1);
  EXPECT_GT(a.pixels, 300) << s.name;
  EXPECT_GT(a.within, 0.9) << s.name;
  EXPECT_LT(std::fabs(a.relative_bias), 0.05) << s.name;
}

TEST(MeasuredPicture, ShadowMapsComeClose) {
  for (const AnalyticScene& s : luminaire_scenes()) {
    const RayScene rays(s.scene);
    const GBuffer gbuffer = trace_gbuffer(rays, s.scene.camera[0], kSide, kSide, {0.5f, 0.5f});
    GlRenderer gl(s.scene);
    std::vector<double> value;
    for (const Rgb& e : gl.direct_illuminance(gbuffer, 256, 512)) value.push_back(static_cast<double>(e.y));
    expect_agreement(s, gbuffer, value);
  }
}

/// Solid openings: maps against shadow rays.
TEST(MeasuredPicture, ShadowMapsOfSolidsComeClose) {
  const auto file = luminaire({[](double c, double g) { return 100 + c * (360 - c) / 324 + g; }, 30, 10, 180},
                              {LuminousOpening::Form::box, {0.6f, 0.3f, 0.2f}});
  AnalyticScene s;
  s.scene = measured_room(file, 0.5f);
  s.scene.camera.push_back(look_at({1.8f, 1, 2.2f}, {-1, -1.5f, -1}, {0, 1, 0}, 1));
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const GBuffer gbuffer = trace_gbuffer(rays, s.scene.camera[0], kSide, kSide, {0.5f, 0.5f});
  GlRenderer gl(s.scene);
  const std::vector<Rgb> maps = gl.direct_illuminance(gbuffer, 256, 512);
  double by_maps = 0, by_rays = 0;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (!gbuffer.covered(i) || s.scene.triangle_instance[gbuffer.hit[i].triangle] != 0) continue;
    RandomStream random(1, Stage::test, i);
    const SurfacePoint p = receiver(s.scene, Vec3(gbuffer.position[i]), Vec3(gbuffer.normal[i]));
    by_rays += static_cast<double>(direct_irradiance(rays, lights, p, 64, random).irradiance.y);
    by_maps += static_cast<double>(maps[i].y);
  }
  EXPECT_NEAR(by_maps / by_rays, 1, 0.05);
}

/// The opening is seen, as bright as intensity over area seen.
TEST(MeasuredPicture, TheOpeningShines) {
  const AnalyticScene s = measured_rectangle();
  const RayScene rays(s.scene);
  SurfacePoint point;
  const Vec3 eye(1, 0.2f, 1.5f), up(0, 1, 0);
  ASSERT_TRUE(trace(rays, {eye, up}, point));
  EXPECT_NEAR(emitted_luminance(s.scene, point, -up).y, 1000, 0.1);
}

}  // namespace
}  // namespace phos::test
