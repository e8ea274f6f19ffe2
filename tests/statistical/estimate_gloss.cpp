// Where secondary rays land on a glossy surface, radiance records say what rays sent on would find.
#include <gtest/gtest.h>

#include "core/random.h"
#include "estimate/radiance_gather.h"
#include "estimate/shading.h"
#include "radiance/gloss_cache.h"
#include "radiance/gloss_tables.h"
#include "record/tree.h"
#include "support/gathered.h"
#include "support/one_material.h"

namespace phos::test {
namespace {

constexpr int kRuns = 1500;

struct Estimate {
  double mean = 0, stderr_of_mean = 0;
};

template <class Value>
Estimate estimate(int runs, const Value& value) {
  double sum = 0, squares = 0;
  for (int i = 0; i < runs; ++i) {
    const auto v = static_cast<double>(value(static_cast<std::uint64_t>(i)));
    sum += v, squares += v * v;
  }
  const double mean = sum / runs;
  return {mean, std::sqrt(std::max(squares / runs - mean * mean, 0.) / (runs - 1))};
}

/// A room of grey walls under a lamp, one wall glossy, a mirror before the wall that faces it.
struct Room {
  Room() : rays(scene), lights(scene) {
    BrdfTableOptions options;
    options.error = 1e-3, options.max_order = 16;
    Counters counters;
    tables = GlossTables(scene, {}, GlossBy::automatic, options, counters);
  }
  static Scene build() {
    Scene s;
    begin_instance(s, "walls", add_lambert(s, "grey", 0.5f));
    add_room(s, Vec3(-2, -1.5f, -2), Vec3(2, 1.5f, 2));
    begin_instance(s, "lamp", add_lambert(s, "lamp", 0, 100));
    add_quad(s, {-0.5f, 1.4f, -0.5f}, {1, 0, 0}, {0, 0, 1});  // faces down
    Material glossy = make_material(Model::phong, Rgb(0.3f, 0.2f, 0.1f), Rgb(0.5f, 0.6f, 0.6f));
    glossy.exponent = 8;
    s.material.push_back(glossy);
    begin_instance(s, "glossy", 2);
    add_quad(s, {1.9f, -1.5f, -2}, {0, 0, 4}, {0, 3, 0});  // faces -x
    s.material.push_back(make_material(Model::mirror, Rgb(0), Rgb(0.9f)));
    begin_instance(s, "mirror", 3);
    add_quad(s, {-1.9f, -0.5f, -1}, {0, 1, 0}, {0, 0, 2});  // faces +x
    finalize(s);
    return s;
  }
  Scene scene = build();
  RayScene rays;
  Luminaires lights;
  GlossTables tables;
  RecordTree indirect = uniform_tree({-2, -1.5f, -2}, {2, 1.5f, 2}, 30);

  RadianceRecord record(const Vec3& position, std::int64_t n) const {
    const RecordOptions options = gather_options(scene, Quantity::indirect, -1, n);
    const RadianceEstimator estimator(rays, lights, {.indirect = &indirect}, options, tables.orders().front(),
                                      RadianceGradient::hybrid, 1);
    const auto worker = estimator.make_worker();
    return *estimator.make({position, {-1, 0, 0}, 1}, *worker).radiance;
  }
};

TEST(Shading, AMirrorShowsRecordsOfAGlossyWall) {
  const Room room;
  GlossCache cache(room.scene.bounds, 0.3, room.tables);
  const Vec3 eye(-1.2f, 0.1f, -0.2f);
  for (const Vec3& seen : {Vec3(-1.9f, 0, 0.1f), Vec3(-1.9f, 0.2f, -0.4f)}) {
    const Vec3 wo = glm::normalize(eye - seen);
    SurfacePoint mirror, wall;
    ASSERT_TRUE(trace(room.rays, {eye, -wo}, mirror));
    const Vec3 on(-wo.x, wo.y, wo.z);
    ASSERT_TRUE(trace(room.rays, {mirror.leave(-on), -on}, wall));
    ASSERT_EQ(wall.material, 2u);
    GlossCache own(room.scene.bounds, 0.3, room.tables);
    own.insert(room.record(wall.position, 40000));
    const Bsdf bsdf(room.scene, mirror);
    const auto shown = [&](const GlossCache* gloss, ShadingLog& log) {
      const Shading shading(room.rays, room.lights, room.indirect, {}, gloss);
      return estimate(kRuns, [&](std::uint64_t run) {
        RandomStream random(3, Stage::test, run);
        return shading.specular(mirror, bsdf, wo, 0, Rgb(1), false, random, log).y;
      });
    };
    ShadingLog log;
    const Estimate traced = shown(nullptr, log), recorded = shown(&own, log);
    EXPECT_TRUE(log.gloss_misses.empty());
    GlossCache::Worker worker;
    const auto stated = static_cast<double>(
        own.outgoing(wall, -glm::normalize(wall.position - mirror.position), worker)->stderr_cd.y);
    const double error = std::hypot(traced.stderr_of_mean, recorded.stderr_of_mean, stated);
    EXPECT_LT(error, 0.03 * traced.mean);
    EXPECT_NEAR(recorded.mean, traced.mean, 3.5 * error + 0.003 * traced.mean);
    EXPECT_LT(recorded.stderr_of_mean, traced.stderr_of_mean) << "no ray is sent on";
    // Where there is no record it is a miss, and rays are sent on.
    const Estimate missed = shown(&cache, log);
    EXPECT_GE(log.gloss_misses.size(), static_cast<std::size_t>(kRuns));
    EXPECT_LT(glm::distance(log.gloss_misses[0].position, wall.position), 1e-5f);
    EXPECT_EQ(missed.mean, traced.mean);
  }
}

TEST(HitLight, GatheredRaysReadRecordsOfAGlossyWall) {
  const Room room;
  GlossCache cache(room.scene.bounds, 0.5, room.tables);
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 10; ++i) {
      const Vec3 p(1.9f, -1.3f + 0.37f * static_cast<float>(j), -1.8f + 0.4f * static_cast<float>(i));
      RadianceRecord r = room.record(p, 1024);
      r.radius_m = 1;
      cache.insert(r);
    }
  Gathered g(room.scene);
  const RecordOptions options = gather_options(room.scene, Quantity::indirect, -1, 256);
  const GatherSource traced{.indirect = &room.indirect};
  GatherSource recorded = traced;
  recorded.gloss = &cache;
  for (const Vec3& p : {Vec3(1, -1.5f, 0), Vec3(1.7f, -1.5f, -1)}) {
    const Trial a = g.trial(p, {0, 1, 0}, options, traced, 0),
                b = g.trial(p, {0, 1, 0}, options, recorded, 0);
    const double error = std::hypot(a.stderr_of_mean, b.stderr_of_mean);
    EXPECT_LT(error, 0.01 * a.mean);
    EXPECT_NEAR(a.mean, b.mean, 3.5 * error + 0.005 * a.mean);
    EXPECT_LT(b.stderr_of_mean, a.stderr_of_mean);
  }
  EXPECT_EQ(g.counters["gathered glossy places without a radiance record"], 0u);
  const GlossCache none(room.scene.bounds, 0.5, room.tables);
  recorded.gloss = &none;
  g.trial({1, -1.5f, 0}, {0, 1, 0}, options, recorded, 0, 1);
  EXPECT_GT(g.counters["gathered glossy places without a radiance record"], 10u);
}

}  // namespace
}  // namespace phos::test
