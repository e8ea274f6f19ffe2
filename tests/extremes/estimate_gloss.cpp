// Lookups of gloss at the extremes: viewers at the horizon and below, nothing glossy, scenes of all sizes,
// records next to walls.
#include <gtest/gtest.h>

#include "estimate/radiance_gather.h"
#include "radiance/gloss_cache.h"
#include "radiance/tree.h"
#include "support/gathered.h"
#include "support/one_material.h"
#include "support/quad.h"
#include "support/radiance_records.h"
#include "support/reflections.h"

namespace phos {
namespace {

using test::make_material;
using test::view;

Scene plane_of(const Material& material) {
  Scene scene;
  scene.material = {material};
  test::add_quad(scene, 1, 1, 0, true, 0);
  return scene;
}
Material phong(float exponent, const Rgb& ks) {
  Material m = make_material(Model::phong, Rgb(0.2f), ks);
  m.exponent = exponent;
  return m;
}
GlossTables tables_of(const Scene& scene, GlossBy by = GlossBy::automatic) {
  Counters counters;
  return GlossTables(scene, {}, by, {}, counters);
}
Bounds box(float half) {
  Bounds b;
  b.include(Vec3(-half)), b.include(Vec3(half));
  return b;
}
Rgb sky(const Vec3& w) { return Rgb(1 + 0.5f * w.x, 1 + 0.4f * w.y * w.z, 0.5f + 0.3f * w.x * w.y); }

TEST(GlossExtremes, ViewersAtTheHorizonAndBelow) {
  for (const GlossBy by : {GlossBy::automatic, GlossBy::cached}) {
    const Scene scene = plane_of(make_material(Model::conductor, Rgb(0), Rgb(0.9f), 0.4f, 0.3f));
    GlossCache cache(box(1), 0.3, tables_of(scene, by));
    cache.insert(test::radiance_record(sky, Vec3(0), Frame(), cache.tables().order(0)));
    GlossCache::Worker worker;
    SurfacePoint point = test::flat_point();
    for (const float theta : {60.f, 80.f, 89.f, 89.9f, 89.9999f}) {
      for (const float phi : {0.f, 45.f, 200.f}) {
        const auto light = cache.outgoing(point, view(theta, phi), worker);
        if (by == GlossBy::cached) {
          EXPECT_TRUE(light) << theta;
        }
        if (!light) continue;
        EXPECT_TRUE(is_finite(light->radiance) && is_finite(light->stderr_cd)) << theta;
        EXPECT_GE(light->radiance.x, 0) << theta;
        EXPECT_LT(light->radiance.x, 3) << theta;
      }
    }
    for (const Vec3& wo : {Vec3(1, 0, 0), Vec3(0, -1, 0), view(91), view(150, 30), Vec3(0, 0, -1)})
      EXPECT_FALSE(cache.outgoing(point, wo, worker)) << wo.z;
    // Above the surface, but below the horizon of a mapped normal; and a normal that looks into the surface.
    point.normal = glm::normalize(Vec3(1, 0, 0.2f));
    point.tangent = make_frame(point.normal).x;
    EXPECT_FALSE(cache.outgoing(point, view(60, 180), worker));
    point.normal = glm::normalize(Vec3(1, 0, -0.2f));
    point.tangent = make_frame(point.normal).x;
    EXPECT_FALSE(cache.outgoing(point, view(60, 0), worker));
  }
}

TEST(GlossExtremes, NothingGlossy) {
  for (const GlossBy by : {GlossBy::automatic, GlossBy::cached}) {
    for (const Material& m : {phong(5, Rgb(0)), make_material(Model::lambert, Rgb(0.5f), Rgb(0)),
                              make_material(Model::mirror, Rgb(0), Rgb(1))}) {
      const Scene scene = plane_of(m);
      const GlossTables tables = tables_of(scene, by);
      EXPECT_TRUE(tables.choices().empty());
      EXPECT_TRUE(tables.orders().empty());
      EXPECT_EQ(tables.order(0), 0);
      GlossCache cache(scene.bounds, 0.3, tables);
      cache.insert(test::radiance_record(sky, Vec3(0), Frame(), 3));
      EXPECT_EQ(cache.size(), 0u);
      GlossCache::Worker worker;
      EXPECT_FALSE(cache.serves(test::flat_point(), view(10), worker));
    }
  }
  EXPECT_TRUE(tables_of(Scene()).orders().empty());
}

/// Kilometres or micrometres: the same light.
TEST(GlossExtremes, ScenesOfAllSizes) {
  const Scene scene = plane_of(phong(8, Rgb(0.8f)));
  Rgb first(0);
  for (const float size : {1.f, 1e-6f, 1e6f}) {
    GlossCache cache(box(size), 0.3, tables_of(scene));
    for (const float x : {-0.1f, 0.1f}) {
      RadianceRecord r = test::radiance_record(sky, {x * size, 0, 0}, Frame(), cache.tables().order(0), size);
      for (std::size_t i = 0; i < r.light.size(); ++i) r.gradient_x[i] = 0.3f * r.light[i] / size;
      cache.insert(r);
    }
    GlossCache::Worker worker;
    SurfacePoint point = test::flat_point();
    point.position = {0.02f * size, 0.01f * size, 0};
    const GlossyLight light = cache.outgoing(point, view(30, 60), worker).value();
    if (size == 1) first = light.radiance;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.radiance[c], first[c], 1e-5f * first[c]) << size;
  }
}

/// Bright and dark light, to the ends of what lamps give.
TEST(GlossExtremes, BrightAndDark) {
  const Scene scene = plane_of(phong(8, Rgb(0.8f)));
  float first = 0;
  for (const float luminance : {1.f, 1e-12f, 1e12f, 0.f}) {
    GlossCache cache(box(1), 0.3, tables_of(scene));
    cache.insert(test::radiance_record([&](const Vec3& w) { return luminance * sky(w); }, Vec3(0), Frame(),
                                       cache.tables().order(0)));
    GlossCache::Worker worker;
    const GlossyLight light = cache.outgoing(test::flat_point(), view(30, 60), worker).value();
    if (luminance == 1) first = light.radiance.x;
    EXPECT_FLOAT_EQ(light.radiance.x, luminance * first);
  }
}

/// Records on a floor at its very edge, where half of the hemisphere is a wall at no distance.
TEST(GlossExtremes, RecordsNextToWalls) {
  const test::AnalyticScene s = test::uniform_box(0.5f);
  Scene scene = s.scene;
  for (Material& m : scene.material) m.model = Model::phong, m.ks = Rgb(0.3f), m.exponent = 8;
  const test::Gathered g(scene);
  const RecordOptions options = test::gather_options(scene, Quantity::indirect, 1, 256);
  const GlossTables tables = tables_of(g.scene);
  const int order = tables.orders().back();
  const RadianceEstimator estimator(g.rays, g.lights, {}, options, order, RadianceGradient::hybrid, 1);
  const auto worker = estimator.make_worker();
  GlossCache cache(g.scene.bounds, 0.3, tables);
  const Bounds& room = g.scene.bounds;
  const float floor = room.lo.y, middle = room.centre().z;
  for (const float inset : {0.f, 1e-7f, 1e-4f, 0.1f}) {
    const Vec3 p(room.lo.x + inset, floor, middle);
    const Made made = estimator.make({p, {0, 1, 0}, 1}, *worker);
    ASSERT_TRUE(is_finite(*made.radiance)) << inset;
    EXPECT_GT(made.radiance->radius_m, 0);
    RadianceRecord r = *made.radiance;
    r.radius_m = std::max(r.radius_m, 0.5f);
    cache.insert(r);
  }
  GlossCache::Worker memory;
  int served = 0;
  for (const float x : {0.f, 1e-6f, 0.01f, 0.05f, 0.1f}) {
    SurfacePoint point;
    point.position = {room.lo.x + x, floor, middle};
    point.geometric_normal = point.smooth_normal = point.normal = {0, 1, 0};
    point.tangent = make_frame(point.normal).x;
    for (const Vec3& wo : {Vec3(0, 1, 0), glm::normalize(Vec3(1, 0.7f, 0.2f))}) {
      const auto light = cache.outgoing(point, wo, memory);
      if (!light) continue;
      ++served;
      EXPECT_TRUE(is_finite(light->radiance));
      EXPECT_GT(light->weight, 0);
      EXPECT_GE(std::min({light->radiance.x, light->radiance.y, light->radiance.z}), 0);
    }
  }
  EXPECT_GE(served, 5);
}

}  // namespace
}  // namespace phos
