// The CPU splatter where a radius, a gradient or a picture is at its limit.
#include <gtest/gtest.h>

#include "splat/cpu/splatter.h"
#include "support/scenes.h"
#include "support/splat_records.h"

namespace phos {
namespace {

class CpuLimits : public ::testing::Test {
 protected:
  test::AnalyticScene s = test::furnace(0.5f);
  RayScene rays{s.scene};
  Camera camera = s.scene.camera[0];
  GBuffer g = trace_gbuffer(rays, camera, 40, 40, {0.5f, 0.5f});

  SplatBuffer draw(const IrradianceRecord& r) const {
    SplatBuffer buffer = splat_on_cpu(std::vector{r}, 0.2, g, camera);
    for (std::size_t i = 0; i < buffer.light.size(); ++i) {
      for (const Vec4& v : {buffer.light[i], buffer.error[i]}) {
        EXPECT_TRUE(is_finite(Vec3(v)) && std::isfinite(v.w));
        EXPECT_TRUE(v.x >= 0 && v.w >= 0);
      }
    }
    return buffer;
  }
  static int drawn(const SplatBuffer& buffer) {
    return static_cast<int>(
        std::count_if(buffer.error.begin(), buffer.error.end(), [](const Vec4& v) { return v.w > 0; }));
  }
  IrradianceRecord at_pixel(std::size_t i) const {
    IrradianceRecord r;
    r.position = Vec3(g.position[i]), r.normal = Vec3(g.normal[i]), r.irradiance = Rgb(7), r.radius_m = 1;
    return r;
  }
};

TEST_F(CpuLimits, Radii) {
  IrradianceRecord r = at_pixel(820);
  int of_this_wall = 0;
  for (std::size_t i = 0; i < g.position.size(); ++i)
    of_this_wall += glm::dot(Vec3(g.normal[i]), r.normal) > 0.99f;
  for (const float radius : {1e6f, 1e30f, kInfinity}) {
    r.radius_m = radius;
    const SplatBuffer buffer = draw(r);
    EXPECT_EQ(drawn(buffer), of_this_wall) << radius;
    EXPECT_NEAR(buffer.light[820].x, 7, 1e-4) << radius;
  }
  for (const float radius : {1e-6f, 1e-30f, std::numeric_limits<float>::min()}) {
    r.radius_m = radius;
    EXPECT_EQ(drawn(draw(r)), 1) << "the pixel it sits on, radius " << radius;
  }
  for (const float radius : {0.f, -1.f}) {
    r.radius_m = radius;
    EXPECT_EQ(drawn(draw(r)), 0) << "cannot be drawn, radius " << radius;
  }
}

TEST_F(CpuLimits, GradientsThatOverflow) {
  IrradianceRecord r = at_pixel(820);
  r.radius_m = 10;
  for (int c = 0; c < 3; ++c) r.translation_gradient[c] = Vec3(3e38f, -3e38f, 3e38f);
  const SplatBuffer buffer = draw(r);
  EXPECT_GT(drawn(buffer), 0);
  for (std::size_t i = 0; i < buffer.light.size(); ++i)
    EXPECT_LE(buffer.light[i].x, 14.001f * buffer.light[i].w);
}

TEST_F(CpuLimits, ManyRecordsInOnePlace) {
  const std::vector<IrradianceRecord> records(5000, at_pixel(820));
  const SplatBuffer buffer = splat_on_cpu(records, 0.2, g, camera);
  EXPECT_EQ(buffer.error[820].w, 5000);
  EXPECT_NEAR(buffer.light[820].x / buffer.light[820].w, 7, 1e-4);
}

TEST_F(CpuLimits, AccuracyFromTinyToLarge) {
  const IrradianceRecord r = at_pixel(820);
  EXPECT_EQ(drawn(splat_on_cpu(std::vector{r}, 1e-6, g, camera)), 1);
  EXPECT_GT(drawn(splat_on_cpu(std::vector{r}, 10, g, camera)), 300);
}

TEST_F(CpuLimits, PicturesOfOnePixelAndOddShapes) {
  for (const auto& [w, h] : {std::pair{1, 1}, {1, 50}, {200, 1}, {17, 15}}) {
    g = trace_gbuffer(rays, camera, w, h, {0.5f, 0.5f});
    IrradianceRecord r = at_pixel(0);
    r.radius_m = 100;
    EXPECT_GE(drawn(draw(r)), 1) << w << " x " << h;
  }
}

TEST_F(CpuLimits, NothingVisible) {
  const test::AnalyticScene plane = test::point_light_over_plane();
  const RayScene plane_rays(plane.scene);
  g = trace_gbuffer(plane_rays, test::look_at({0, 1, 0}, {0, 2, 0.1f}, {0, 0, 1}, 0.5f), 16, 16,
                    {0.5f, 0.5f});
  IrradianceRecord r;
  r.irradiance = Rgb(5), r.radius_m = kInfinity;
  EXPECT_EQ(drawn(draw(r)), 0);
}

}  // namespace
}  // namespace phos
