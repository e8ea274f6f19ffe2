// Light of lamps by shadow maps in memory, against closed forms, against shadow rays, and in records
// (docs/methods.md#r3).
#include <gtest/gtest.h>

#include "direct/direct_light.h"
#include "splat/gl/mesh.h"
#include "splat/raster/hemisphere_raster.h"
#include "splat/raster/lamp_maps.h"
#include "splat/raster/radiance_raster.h"
#include "support/gathered.h"
#include "support/radiance_scenes.h"
#include "support/raster.h"

namespace phos::test {
namespace {

struct Maps {
  explicit Maps(const Scene& scene) : mesh(context.gl(), scene), lamps(context, mesh, scene) {}
  /// Over all places on each lamp.
  double mean_lx(const SurfacePoint& at) const {
    double sum = 0;
    constexpr int kTurns = 1024;
    for (std::uint32_t turn = 0; turn < kTurns; ++turn)
      sum += static_cast<double>(lamps.lux(at, turn).y) / kTurns;
    return sum;
  }
  GlContext context;
  GlMesh mesh;
  LampMaps lamps;
};

/// Where lamps alone give light, or all but lamps is dark.
TEST(LampMaps, AgreeWithTheClosedForm) {
  for (const AnalyticScene& s : {point_light_over_plane(), rectangle_light_parallel(),
                                 rectangle_light_perpendicular(), thin_walls(), two_sided_sheet()}) {
    const Maps maps(s.scene);
    for (const Check& c : s.checks) {
      const bool point = s.scene.light[0].kind != Light::Kind::area;
      const double found = maps.mean_lx(receiver(s.scene, c.position, c.normal));
      EXPECT_NEAR(found, c.irradiance_lx, (point ? 1e-4 : 0.06) * c.irradiance_lx) << s.name;
    }
  }
}

/// A plate under a point lamp, a spot and a sun: in its shadow the floor is dark, beside it it is not; a
/// filter of 4 x 4 texels leaves shares between at the edge alone.
TEST(LampMaps, PlatesThrowShadows) {
  for (const Light::Kind kind : {Light::Kind::point, Light::Kind::spot, Light::Kind::directional}) {
    Scene scene;
    begin_instance(scene, "floor", add_lambert(scene, "white", 0.5f));
    add_quad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
    begin_instance(scene, "plate", 0);
    add_quad(scene, {0.2f, 1, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f});
    Light light;
    light.kind = kind, light.position = {0, 2, 0}, light.direction = {0, -1, 0}, light.intensity = Rgb(100);
    light.cos_inner = 0.75, light.cos_outer = 0.7;
    scene.light.push_back(light);
    finalize(scene);
    const Maps maps(scene);
    const float grown = kind == Light::Kind::directional ? 1 : 2;
    for (float x = -0.4f; x < 1.5f; x += 0.011f) {
      const SurfacePoint at = receiver(scene, {x, 0, 0.03f}, {0, 1, 0});
      const float from_edge = std::min(x - 0.2f * grown, 0.6f * grown - x);
      const double open =
          kind == Light::Kind::directional ? 100 : point_over_plane_lx(100, 2, std::hypot(x, 0.03));
      if (std::fabs(from_edge) < 0.02f) continue;
      EXPECT_NEAR(maps.lamps.lux(at, 0).y, from_edge > 0 ? 0 : open, 1e-4 * open) << x;
    }
  }
}

/// In the Cornell box, where shadows have borders and blocks touch the floor: the mean over places is that of
/// shadow rays to 2 %, and most places are within a twentieth.
TEST(LampMaps, AgreeWithShadowRays) {
  const Scene scene = cornell();
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const Maps maps(scene);
  double by_maps = 0, by_rays = 0;
  int places = 0, off = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    RandomStream random(3, Stage::test, i);
    const Camera::Ray ray = scene.camera[0].ray(random.uniform2(), 1);
    SurfacePoint point;
    if (!trace(rays, {ray.origin, ray.direction}, point)) continue;
    std::vector<LampSample> samples;
    sample_lamps(rays, lights, point, 256, random, samples);
    const double traced = static_cast<double>(Rgb(light_of(samples)).y), mapped = maps.mean_lx(point);
    by_rays += traced, by_maps += mapped, ++places;
    off += std::fabs(mapped - traced) > 0.05 * traced + 1;
  }
  ASSERT_GT(places, 200);
  EXPECT_NEAR(by_maps / by_rays, 1, 0.02);
  EXPECT_LT(off, places / 5);
}

/// Records of both kinds, lit by maps and by rays: the same but for the rays' noise.
TEST(LampMaps, RecordsAgreeWithTracedLight) {
  constexpr int kOrder = 5;
  const Scene scene = cornell();
  const RayScene rays(scene);
  const Luminaires lights(scene);
  RecordOptions traced = raster_options(scene, Estimate::raster), mapped = traced;
  mapped.raster_light = RasterLight::shadow_map;
  const RasterEstimator a(rays, lights, {}, traced, 1), b(rays, lights, {}, mapped, 1);
  const RadianceRasterEstimator c(rays, lights, {}, traced, kOrder, RadianceGradient::none, 1),
      d(rays, lights, {}, mapped, kOrder, RadianceGradient::none, 1);
  const auto worker_a = a.make_worker(), worker_b = b.make_worker(), worker_c = c.make_worker(),
             worker_d = d.make_worker();
  double sum_a = 0, sum_b = 0, squares = 0;
  int places = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    RandomStream random(7, Stage::test, i);
    const Camera::Ray ray = scene.camera[0].ray(random.uniform2(), 1);
    SurfacePoint point;
    if (!trace(rays, {ray.origin, ray.direction}, point)) continue;
    const RecordSite site{point.position, point.smooth_normal, i};
    const Rgb by_rays = a.make(site, *worker_a).record.irradiance,
              by_maps = b.make(site, *worker_b).record.irradiance;
    EXPECT_NEAR(by_maps.y / by_rays.y, 1, 0.1) << i;
    sum_a += static_cast<double>(by_rays.y), sum_b += static_cast<double>(by_maps.y), ++places;
    const auto light = channel(c.make(site, *worker_c).radiance->light);
    const auto mapped_light = channel(d.make(site, *worker_d).radiance->light);
    const double off = distance(mapped_light, light) / norm(light);
    squares += off * off;
  }
  ASSERT_GT(places, 30);
  RecordProperty("irradiance", std::to_string(sum_b / sum_a));
  RecordProperty("coefficients", std::to_string(std::sqrt(squares / places)));
  EXPECT_NEAR(sum_b / sum_a, 1, 0.02);
  EXPECT_LT(std::sqrt(squares / places), 0.1);
}

}  // namespace
}  // namespace phos::test
