// Rasterising, splatting and shadow maps do not know the unit of length, nor where the origin is.
#include <gtest/gtest.h>

#include "splat/cpu/splatter.h"
#include "splat/gl/renderer.h"
#include "support/gl.h"
#include "support/scenes.h"
#include "support/splat_records.h"

namespace phos {
namespace {

constexpr int kWidth = 80, kHeight = 60;

void expect_all_agree(const Scene& scene, float size_m) {
  const RayScene rays(scene);
  const Camera& camera = scene.camera[0];
  GlRenderer gl(scene);
  const GBuffer traced = trace_gbuffer(rays, camera, kWidth, kHeight, {0.5f, 0.5f});
  const GBuffer drawn = gl.rasterise(camera, kWidth, kHeight, {0.5f, 0.5f});
  int other = 0;
  for (std::size_t i = 0; i < traced.position.size(); ++i) {
    ASSERT_EQ(traced.covered(i), drawn.covered(i));
    const float apart = glm::distance(Vec3(traced.position[i]), Vec3(drawn.position[i]));
    other += !(apart < 1e-3f * size_m) || traced.hit[i].triangle != drawn.hit[i].triangle;
  }
  EXPECT_LT(other, kWidth * kHeight / 100);

  const std::vector<IrradianceRecord> records =
      test::records_in_view(rays, camera, 200, 0.1f * size_m, 2 * size_m);
  const SplatBuffer by_cpu = splat_on_cpu(records, 0.25, traced, camera);
  const test::SplatDifference gl_d = test::difference(by_cpu, gl.splat(records, 0.25, traced, camera));
  EXPECT_TRUE(gl_d.finite);
  EXPECT_LE(gl_d.other_records, 3u);
  EXPECT_LT(gl_d.relative, 1e-4);
  EXPECT_GT(gl_d.drawn, std::size_t{kWidth * kHeight * 9 / 10});
  const test::SplatDifference own = test::difference(by_cpu, test::splat_one_by_one(records, 0.25f, traced));
  EXPECT_LE(own.other_records, 3u);
  EXPECT_LT(own.relative, 1e-4);
}

double mean_direct_lx(const Scene& scene) {
  const RayScene rays(scene);
  const GBuffer g = trace_gbuffer(rays, scene.camera[0], kWidth, kHeight, {0.5f, 0.5f});
  double sum = 0;
  for (const Rgb& e : GlRenderer(scene).direct_illuminance(g, 4, 256))
    sum += double(e.x) / (kWidth * kHeight);
  return sum;
}

TEST(Scale, FromAMicrometreToAThousandKilometres) {
  const test::AnalyticScene s = test::uniform_box(0.5f);
  const double mean = mean_direct_lx(s.scene);
  EXPECT_GT(mean, 1);
  for (const float factor : {1e-6f, 1.f, 1e6f}) {
    SCOPED_TRACE(factor);
    const Scene scene = test::scaled(s.scene, factor);
    expect_all_agree(scene, factor);
    EXPECT_NEAR(mean_direct_lx(scene) / mean, 1, 2e-3);
  }
}

TEST(Scale, AreaLightsToo) {
  const test::AnalyticScene s = test::rectangle_light_parallel();
  const double mean = mean_direct_lx(s.scene);
  for (const float factor : {1e-6f, 1e6f})
    EXPECT_NEAR(mean_direct_lx(test::scaled(s.scene, factor)) / mean, 1, 2e-3);
}

TEST(Scale, FarFromTheOrigin) {
  Scene scene = test::uniform_box(0.5f).scene;
  const Vec3 away(1000, -2000, 500);  // positions are then rounded to 1e-4 m
  for (Vec3& p : scene.position) p += away;
  for (Light& light : scene.light) light.position += away;
  for (Camera& camera : scene.camera) camera.to_world[3] += Vec4(away, 0);
  scene.bounds = {};
  finalize(scene);
  expect_all_agree(scene, 1);
  EXPECT_NEAR(mean_direct_lx(scene) / mean_direct_lx(test::uniform_box(0.5f).scene), 1, 5e-3);
}

}  // namespace
}  // namespace phos
