// Direct light at visible points, by shadow rays and by shadow maps, against closed forms (derivations:
// tests/support/scenes.h).
#include <gtest/gtest.h>

#include "cache/shading.h"
#include "splat/interleaved.h"
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

/// One pass of interleaved rays over a scene, as pixels of illuminance.
struct Interleaved {
  Interleaved(const AnalyticScene& s, int rays_of_each) : rays(s.scene), lights(s.scene) {
    const Vec2 middle(0.5f);
    gbuffer = trace_gbuffer(rays, s.scene.camera[0], kSide, kSide, middle);
    light = interleaved_light(rays, lights, gbuffer, PixelRays(s.scene.camera[0], kSide, kSide), middle,
                              rays_of_each, 0, 1);
    for (const SharedLight& l : light) {
      value.push_back(static_cast<double>(l.illuminance.y));
      error.push_back(std::sqrt(static_cast<double>(l.variance.y)));
    }
  }
  RayScene rays;
  Luminaires lights;
  GBuffer gbuffer;
  std::vector<SharedLight> light;
  std::vector<double> value, error;
};

/// Pixels share rays with their own surface alone: the mean holds, and what light changes over four pixels is
/// all the blur there is.
TEST_P(SceneWithDarkSurfaces, InterleavedRaysAgreeWithTheClosedForm) {
  const AnalyticScene s = std::move(all_point_scenes()[GetParam()]);
  const Interleaved four(s, 4);
  const Agreement a = compare(s, four.gbuffer, four.value, four.error, 0.05);
  EXPECT_GT(a.pixels, 300) << s.name;
  EXPECT_GT(a.within, 0.97) << s.name;
  EXPECT_LT(std::fabs(a.relative_bias), 0.01) << s.name;
}

/// A lamp that is seen whole is the closed form, and noise is left at shadows alone.
TEST(Interleaved, HasNoNoiseWhereTheLampIsSeenWhole) {
  const AnalyticScene s = rectangle_light_parallel();
  const Interleaved shared(s, 1);
  std::size_t whole = 0;
  for (std::size_t i = 0; i < shared.light.size(); ++i) {
    const Vec3 p(shared.gbuffer.position[i]), normal(shared.gbuffer.normal[i]);
    if (!shared.gbuffer.covered(i) || normal.y < 0.5f || p.y > 0.1f) continue;
    if (shared.light[i].variance != DVec3(0)) continue;
    const double truth = s.irradiance_lx(p, normal);
    EXPECT_NEAR(shared.value[i], truth, 1e-4 * truth);
    ++whole;
  }
  EXPECT_GT(whole, 300u);
}

/// Sixteen times as many rays' worth: the error of one ray each is well below that of single rays alone.
TEST(Interleaved, SharesWhatNeighboursFind) {
  const AnalyticScene s = rectangle_light_parallel();
  const Interleaved shared(s, 1);
  const RecordTree no_records(s.scene.bounds, 0.2);
  const Shading shading(shared.rays, shared.lights, no_records, {});
  double own = 0, together = 0, n = 0;
  for (std::size_t i = 0; i < shared.light.size(); ++i) {
    if (!shared.gbuffer.covered(i)) continue;
    const Vec3 p(shared.gbuffer.position[i]), normal(shared.gbuffer.normal[i]);
    if (normal.y < 0.5f || p.y > 0.1f) continue;
    const double truth = s.irradiance_lx(p, normal);
    RandomStream random(1, Stage::test, i);
    SurfacePoint point;
    ASSERT_TRUE(trace(shared.rays, {p + 0.004f * normal, -normal}, point));
    const DirectLight alone = shading.direct(point, Bsdf(s.scene, point), normal, 1, 0, random);
    own += std::pow(static_cast<double>(alone.illuminance.y) - truth, 2);
    together += std::pow(shared.value[i] - truth, 2), n += 1;
  }
  ASSERT_GT(n, 300);
  EXPECT_LT(std::sqrt(together / n), 0.4 * std::sqrt(own / n));
}

INSTANTIATE_TEST_SUITE_P(Most, SceneWithDarkSurfaces, testing::Values(0, 1, 2, 8, 9));
INSTANTIATE_TEST_SUITE_P(All, EveryScene, testing::Range<std::size_t>(0, 10));

}  // namespace
}  // namespace phos::test
