// Direct light at visible points, by shadow rays and by shadow maps, against closed forms (derivations:
// tests/support/scenes.h).
#include <gtest/gtest.h>

#include "cache/shading.h"
#include "support/splat_scenes.h"

namespace phos::test {
namespace {

constexpr int kSide = 48;

/// What arrives straight from the lamps where `truth` counts all bounces; nothing but the furnace reflects
/// onto what is looked at.
double direct_lx(const AnalyticScene& s, const Check& check) {
  return s.name == "furnace" ? std::numbers::pi * static_cast<double>(s.scene.material[0].emission.x)
                             : check.irradiance_lx;
}

class EveryScene : public testing::TestWithParam<std::size_t> {};

/// A Lambert surface under E reflects rho E / pi. The stated variance is that of independent samples; the
/// points are of low discrepancy, so the error is less.
TEST_P(EveryScene, ShadowRaysAgreeWithTheClosedForm) {
  const AnalyticScene s = std::move(all_point_scenes()[GetParam()]);
  const RayScene rays(s.scene);
  const Luminaires lights(s.scene);
  const RecordTree no_records(s.scene.bounds, 0.2);
  const Shading shading(rays, lights, no_records, {});
  std::uint64_t item = 0;
  for (const Check& check : s.checks) {
    const Vec3 from = check.position + 0.004f * check.normal;
    SurfacePoint point;
    ASSERT_TRUE(trace(rays, {from, -check.normal}, point)) << s.name;
    const Bsdf bsdf(s.scene, point);
    const double truth = direct_lx(s, check);
    for (const int samples : {1, 16, 4096}) {
      RandomStream random(1, Stage::test, item++);
      const DirectLight light = shading.direct(point, bsdf, check.normal, samples, 0, random);
      const double scale = std::numbers::pi / static_cast<double>(bsdf.diffuse_reflectance().y);
      const double e = static_cast<double>(light.radiance.y) * scale;
      EXPECT_NEAR(static_cast<double>(light.illuminance.y), e, 1e-4 * e) << s.name;
      if (samples == 1 && s.scene.light[0].kind == Light::Kind::area) continue;
      const double error = std::sqrt(static_cast<double>(light.variance.y)) * scale;
      EXPECT_NEAR(e, truth, 4 * error + 1e-3 * truth) << s.name << ", " << samples;
      if (samples == 4096) {
        EXPECT_LT(error, 0.05 * truth + 1e-9) << s.name;
      }
    }
  }
}

/// All but the furnace and the glowing environment, where every wall is a lamp.
class SceneWithDarkSurfaces : public testing::TestWithParam<std::size_t> {};

/// Shadow maps are a preview: most pixels within a tenth, the mean within a twentieth.
TEST_P(SceneWithDarkSurfaces, ShadowMapsComeClose) {
  const AnalyticScene s = std::move(all_point_scenes()[GetParam()]);
  const RayScene rays(s.scene);
  const GBuffer gbuffer = trace_gbuffer(rays, s.scene.camera[0], kSide, kSide, {0.5f, 0.5f});
  GlRenderer gl(s.scene);
  const std::vector<Rgb> light = gl.direct_illuminance(gbuffer, 256, 512);
  std::vector<double> value(light.size()), no_error(light.size(), 0);
  for (std::size_t i = 0; i < light.size(); ++i) value[i] = static_cast<double>(light[i].y);
  const Agreement a = compare(s, gbuffer, value, no_error, 0.1);
  EXPECT_GT(a.pixels, 300) << s.name;
  EXPECT_GT(a.within, 0.9) << s.name;
  EXPECT_LT(std::fabs(a.relative_bias), 0.05) << s.name;
}

INSTANTIATE_TEST_SUITE_P(Most, SceneWithDarkSurfaces, testing::Values(0, 1, 2, 8, 9));
INSTANTIATE_TEST_SUITE_P(All, EveryScene, testing::Range<std::size_t>(0, 10));

}  // namespace
}  // namespace phos::test
