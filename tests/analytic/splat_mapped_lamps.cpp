// Shadow maps with percentage-closer filtering in pictures: shadow edges, gloss, and the samples of edges.
#include <gtest/gtest.h>

#include "direct/direct_light.h"
#include "scene/material/bsdf.h"
#include "splat/gl/lamp_map.h"
#include "splat/gl/renderer.h"
#include "splat/picture/mapped_lamps.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

constexpr int kSide = 64;

/// A plate half way between a point lamp and the floor.
AnalyticScene plate_under_lamp() {
  AnalyticScene s = point_light_over_plane();
  Scene with;
  begin_instance(with, "floor", add_lambert(with, "white", 0.5f));
  add_quad(with, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  begin_instance(with, "plate", 0);
  add_quad(with, {0.2f, 1, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f});
  add_point_light(with, {0, 2, 0}, 100);
  with.camera.push_back(look_at({0, 3, 0.1f}, {0, 0, 0}, {0, 0, -1}, 1));
  finalize(with);
  s.scene = std::move(with);
  return s;
}

/// OpenGL's sum and maps that are read back agree, with a filter or without; filters leave shares between at
/// the edges of shadows, and change nothing elsewhere.
TEST(MappedLamps, TheFilterSoftensEdgesAlone) {
  const AnalyticScene s = plate_under_lamp();
  const RayScene rays(s.scene);
  const GBuffer g = trace_gbuffer(rays, s.scene.camera[0], kSide, kSide, {0.5f, 0.5f});
  const PixelRays pixel_rays(s.scene.camera[0], kSide, kSide);
  std::vector<SeenSample> samples;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      samples.push_back({pixel_rays(x, y, {0.5f, 0.5f}),
                         g.hit[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)]});
  GlRenderer gl(s.scene);
  const std::vector<Rgb> hard = gl.direct_illuminance(g, 1, 128);
  for (const int taps : {1, 2, 4}) {
    const std::vector<Rgb> soft = gl.direct_illuminance(g, 1, 128, taps);
    std::vector<LampsAt> read(samples.size());
    const MappedLamps lamps(rays, taps, true);
    int places = 0;
    gl.each_lamp_map(g, 1, 128, [&](const LampMap& map, bool extended) {
      EXPECT_FALSE(extended);
      ++places, lamps.add(map, extended, samples, read);
    });
    EXPECT_EQ(places, 1);
    int between = 0, differ = 0, off = 0, seen = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!g.covered(i)) continue;
      const double open = point_over_plane_lx(100, 2 - static_cast<double>(g.position[i].y),
                                              std::hypot(g.position[i].x, g.position[i].z));
      ++seen;
      between += soft[i].y > 0.01 * open && soft[i].y < 0.99 * open;
      differ += std::fabs(soft[i].y - hard[i].y) > 0.01 * open;
      off += std::fabs(read[i].lux.y - soft[i].y) > 1e-3 * open;
      EXPECT_EQ(read[i].point_gloss, Rgb(0));
    }
    ASSERT_GT(seen, 1000);
    EXPECT_LE(off, seen / 200) << taps;
    EXPECT_EQ(taps == 1 ? between : 0, 0);
    if (taps == 4) {
      EXPECT_GT(between, 10);
    }
    EXPECT_LE(differ, seen / 10) << taps;
  }
}

/// Gloss of a lamp: the lobe times the light that arrives, and nothing in the shadow.
TEST(MappedLamps, LightGloss) {
  AnalyticScene s = plate_under_lamp();
  Material& floor = s.scene.material[0];
  floor.model = Model::phong, floor.kd = Rgb(0.2f), floor.ks = Rgb(0.5f), floor.exponent = 20;
  const RayScene rays(s.scene);
  const GBuffer g = trace_gbuffer(rays, s.scene.camera[0], kSide, kSide, {0.5f, 0.5f});
  const PixelRays pixel_rays(s.scene.camera[0], kSide, kSide);
  GlRenderer gl(s.scene);
  std::vector<SeenSample> samples;
  for (int x = 2; x < kSide; x += 3) {
    const std::size_t i = static_cast<std::size_t>(kSide / 2) * kSide + static_cast<std::size_t>(x);
    if (g.covered(i) && g.position[i].y < 0.5f)
      samples.push_back({pixel_rays(x, kSide / 2, {0.5f, 0.5f}), g.hit[i]});
  }
  ASSERT_GT(samples.size(), 8u);
  std::vector<LampsAt> light(samples.size());
  const MappedLamps lamps(rays, 4, true);
  gl.each_lamp_map(g, 1, 512,
                   [&](const LampMap& map, bool extended) { lamps.add(map, extended, samples, light); });
  int lit = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const SurfacePoint p = rays.surface(samples[i].ray, samples[i].hit);
    const double d = glm::length(Vec2(p.position.x, p.position.z));
    if (light[i].lux == Rgb(0)) {
      EXPECT_EQ(light[i].point_gloss, Rgb(0));
      continue;
    }
    const double open = point_over_plane_lx(100, 2, d);
    if (static_cast<double>(light[i].lux.y) < 0.999 * open) continue;  // at the edge of the shadow
    const Bsdf bsdf(s.scene, p);
    const Rgb f = bsdf.evaluate_gloss(-samples[i].ray.direction, glm::normalize(Vec3(0, 2, 0) - p.position));
    EXPECT_NEAR(light[i].point_gloss.y, static_cast<double>(f.y) * open,
                1e-3 * static_cast<double>(f.y) * open + 1e-6);
    EXPECT_EQ(light[i].extended_gloss, Rgb(0));
    lit += f.y > 0;
  }
  EXPECT_GT(lit, 3);
}

}  // namespace
}  // namespace phos::test
