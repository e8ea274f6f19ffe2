// Splatted irradiance against every scene whose light is known in closed form (derivations:
// tests/support/scenes.h): photons -> records -> splats, direct light included, on the CPU and in OpenGL.
#include <gtest/gtest.h>

#include "support/splat_scenes.h"

#include "splat/gl/renderer.h"

namespace phos::test {
namespace {

constexpr int kSide = 48;
constexpr Vec2 kCentre{0.5f, 0.5f};
/// Of the records; small, so that interpolation between them errs little.
constexpr double kAccuracy = 0.1;
/// For what interpolation and the estimate's finite zone leave out (curvature of E; zero in the furnace).
constexpr double kAllowance = 0.02;

/// Paths that leave about as many photons in each scene (a path lands 1 / (1 - albedo) times).
std::int64_t paths_for(const AnalyticScene& s) {
  const double albedo = static_cast<double>(s.scene.material[0].kd.x);
  const bool even = s.name == "furnace" || s.name == "emitting environment";  // no shape to be resolved
  return static_cast<std::int64_t>((even ? 400000 : 1600000) * std::max(0.02, 1 - albedo));
}

void expect_agreement(const Agreement& a, const std::string& what) {
  EXPECT_GT(a.pixels, 300) << what;
  EXPECT_LT(a.missing, 0.01) << what;
  EXPECT_GT(a.within, 0.95) << what;
  EXPECT_GT(a.within_two, 0.85) << what;
  EXPECT_LT(std::fabs(a.relative_bias), 0.01) << what;
  EXPECT_LT(a.relative_error, 0.1) << what;  // the allowed deviation is not vast
}

class EveryScene : public testing::TestWithParam<std::size_t> {};

TEST_P(EveryScene, SplatsAgreeWithTheClosedForm) {
  const AnalyticScene s = std::move(all_point_scenes()[GetParam()]);
  const Lit lit = light_up(s.scene, paths_for(s));
  const Camera& camera = s.scene.camera[0];
  const GBuffer traced = trace_gbuffer(*lit.rays, camera, kSide, kSide, kCentre);
  const IrradianceCache cache = records_in_view(lit, traced, Quantity::all, kAccuracy);
  const SplatBuffer on_cpu = splat_on_cpu(cache.records, kAccuracy, traced, camera);
  expect_agreement(compare(s, traced, on_cpu, kAllowance), s.name + ", cpu");

  GlRenderer gl(*lit.scene);
  const GBuffer drawn = gl.rasterise(camera, kSide, kSide, kCentre);
  expect_agreement(compare(s, drawn, gl.splat(cache.records, kAccuracy, drawn, camera), kAllowance),
                   s.name + ", gl");
}

INSTANTIATE_TEST_SUITE_P(All, EveryScene, testing::Range<std::size_t>(0, 10));

/// A lamp in the middle of a sphere lights every point alike: E = P / (A (1 - rho)) to within the facets'
/// deviation from the sphere (1280 facets: angle to the radius up to 3.5 degrees, so 1 - cos < 0.2 % of
/// direct light, and 1/r2 < 1.5 %).
TEST(IntegratingSphere, IsEvenlyLit) {
  const AnalyticScene s = integrating_sphere(0.8f, 1280);
  const Lit lit = light_up(s.scene, 150000);
  const Camera& camera = s.scene.camera[0];
  const GBuffer gbuffer = trace_gbuffer(*lit.rays, camera, kSide, kSide, kCentre);
  const IrradianceCache cache = records_in_view(lit, gbuffer, Quantity::all, kAccuracy);
  expect_agreement(compare(s, gbuffer, splat_on_cpu(cache.records, kAccuracy, gbuffer, camera), kAllowance),
                   s.name);
}

/// Neither side of a wall without thickness sees the light of the other: the dark wall 1 cm behind the lit
/// one and the backs of both stay black.
TEST(ThinWalls, DoNotLeak) {
  AnalyticScene s = thin_walls();
  s.scene.camera[0] = look_at({0.5f, 0.5f, -3}, {0, 0, 0}, {0, 1, 0}, 0.8f);
  const Lit lit = light_up(s.scene, 200000);
  const GBuffer gbuffer = trace_gbuffer(*lit.rays, lit.scene->camera[0], kSide, kSide, kCentre);
  // Records of the lit side, as another view would have left them.
  IrradianceCache cache = empty_cache(Quantity::all, 0.3);
  RecordOptions options = all_light(*lit.scene);
  options.accuracy = 0.3;
  Counters counters;
  place_at_photons(cache, lit.photons, *lit.rays, options, {.max_candidates = 20000}, 1, counters);
  ASSERT_GT(cache.records.size(), 10u);
  const SplatBuffer splats = splat_on_cpu(cache.records, 0.3, gbuffer, lit.scene->camera[0]);
  GlRenderer gl(*lit.scene);
  const SplatBuffer drawn = gl.splat(cache.records, 0.3, gbuffer, lit.scene->camera[0]);
  for (std::size_t i = 0; i < splats.light.size(); ++i) {
    EXPECT_EQ(splats.light[i].y, 0) << i;
    EXPECT_EQ(drawn.light[i].y, 0) << i;
  }
}

/// A plan: the floor from straight above, without perspective.
TEST(Orthographic, SplatsAgreeWithTheClosedForm) {
  AnalyticScene s = point_light_over_plane();
  Camera camera = look_at({0, 20, 0}, {0, 0, 0}, {0, 0, -1}, 1);
  camera.perspective = false;
  camera.ymag_m = 4;
  const Lit lit = light_up(s.scene, 1600000);
  const GBuffer gbuffer = trace_gbuffer(*lit.rays, camera, kSide, kSide, kCentre);
  const IrradianceCache cache = records_in_view(lit, gbuffer, Quantity::all, kAccuracy);
  expect_agreement(compare(s, gbuffer, splat_on_cpu(cache.records, kAccuracy, gbuffer, camera), kAllowance),
                   "plan, cpu");
  GlRenderer gl(*lit.scene);
  const GBuffer drawn = gl.rasterise(camera, kSide, kSide, kCentre);
  expect_agreement(compare(s, drawn, gl.splat(cache.records, kAccuracy, drawn, camera), kAllowance),
                   "plan, gl");
}

/// Sizes from a micrometre to a thousand kilometres give the same picture.
TEST(Scale, DoesNotMatter) {
  const AnalyticScene original = rectangle_light_parallel();
  for (const float factor : {1e-6f, 1e-3f, 1e6f}) {
    const AnalyticScene s = scaled(original, factor);
    const Lit lit = light_up(s.scene, 800000);
    const Camera& camera = s.scene.camera[0];
    const GBuffer gbuffer = trace_gbuffer(*lit.rays, camera, 24, 24, kCentre);
    const IrradianceCache cache = records_in_view(lit, gbuffer, Quantity::all, 0.2);
    GlRenderer gl(*lit.scene);
    for (const SplatBuffer& splats :
         {splat_on_cpu(cache.records, 0.2, gbuffer, camera), gl.splat(cache.records, 0.2, gbuffer, camera)}) {
      const Agreement a = compare(s, gbuffer, splats, 0.04);
      EXPECT_GT(a.pixels, 100) << s.name;
      EXPECT_EQ(a.missing, 0) << s.name;
      EXPECT_GT(a.within, 0.9) << s.name;
      EXPECT_LT(std::fabs(a.relative_bias), 0.02) << s.name;
    }
  }
}

}  // namespace
}  // namespace phos::test
