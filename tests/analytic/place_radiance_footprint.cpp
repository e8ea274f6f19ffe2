// Adaptive footprints of radiance records: fewer places for the same error in a corridor with a glossy floor.
#include <gtest/gtest.h>

#include "estimate/radiance_gather.h"
#include "place/modes.h"
#include "place/radiance_placement.h"
#include "radiance/gloss_cache.h"
#include "scene/lamp/luminaires.h"
#include "support/gloss_scenes.h"
#include "support/glossy_room.h"

namespace phos {
namespace {

/// 2 m wide, 2.4 m high and 8 m long, with four lamps under the ceiling.
Scene corridor() {
  Scene scene;
  const std::uint32_t walls = test::add_lambert(scene, "walls", 0.7f),
                      floor = test::add_phong(scene, "floor", Rgb(0.2f), 10);
  const Vec3 x(2, 0, 0), y(0, 2.4f, 0), z(0, 0, 8);
  test::begin_instance(scene, "walls", walls);
  test::add_quad(scene, y, x, z);
  test::add_quad(scene, {}, y, z), test::add_quad(scene, x, z, y);
  test::add_quad(scene, {}, x, y), test::add_quad(scene, z, y, x);
  test::begin_instance(scene, "floor", floor);
  test::add_quad(scene, {}, z, x);
  for (const float at : {1.f, 3.f, 5.f, 7.f}) test::add_point_light(scene, {1, 2.2f, at}, 100);
  scene.camera.push_back(test::look_at({1, 1.6f, 7.9f}, {1, 0, 4}, {0, 1, 0}, 1.2f));
  finalize(scene);
  return scene;
}

struct Measured {
  std::size_t records = 0;
  double error = 0;  ///< root mean square over the root mean square of the light
  int missed = 0;
};

/// Light of one bounce that leaves the floor towards the camera: from records, and from many rays at each
/// point.
struct Ground {
  static constexpr int kSide = 16;
  struct View {
    SurfacePoint point;
    Vec3 wo;
    double truth = 0;
  };
  Scene scene = corridor();
  RayScene rays{scene};
  Luminaires lights{scene};
  GlossTables tables = test::gloss_tables(scene);
  std::vector<View> views;

  Ground() {
    RadianceOptions many = options(Footprint::circle, 0.3);
    many.records.rays = 16384;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Vec2 st = (Vec2(i % kSide, i / kSide) + 0.5f) / static_cast<float>(kSide);
      const Camera::Ray eye = scene.camera[0].ray(st, 1);
      View view{{}, -eye.direction};
      if (!trace(rays, {eye.origin, eye.direction}, view.point)) continue;
      const int order = tables.order(view.point.material);
      if (order == 0) continue;
      const RadianceEstimator estimator(rays, lights, {}, many.records, order, RadianceGradient::none, 99);
      const auto worker = estimator.make_worker();
      GlossCache exact(scene.bounds, 0.2, tables);
      exact.insert(
          *estimator
               .make({view.point.position, view.point.smooth_normal, static_cast<std::uint64_t>(i)}, *worker)
               .radiance);
      GlossCache::Worker lookup;
      view.truth = static_cast<double>(luminance(exact.outgoing(view.point, view.wo, lookup)->radiance));
      views.push_back(view);
    }
  }

  RadianceOptions options(Footprint footprint, double accuracy) const {
    RadianceOptions o;
    o.records.rays = 1024, o.records.gather_bounces = 1;
    o.records.footprint = footprint, o.records.rho = 0.2, o.records.accuracy = accuracy;
    o.records.resolve(1.5f);
    return o;
  }

  Measured measure(Footprint footprint, double accuracy) const {
    const RadianceOptions chosen = options(footprint, accuracy);
    RadianceCache cache;
    cache.accuracy = accuracy;
    PlacementOptions placement{.place = Place::view, .width = 64};
    resolve(placement, scene, {}, accuracy);
    Counters events;
    place_radiance(
        cache, tables,
        [&](int order) {
          return std::make_unique<RadianceEstimator>(rays, lights, GatherSource(), chosen.records, order,
                                                     chosen.gradients, 1);
        },
        rays, chosen.records, placement, {}, events);
    GlossCache gloss(scene.bounds, reading_accuracy(cache), tables);
    for (const RadianceRecord& r : cache.records) gloss.insert(r);
    GlossCache::Worker lookup;
    Measured m{.records = cache.records.size()};
    double off = 0, light = 0;
    for (const View& view : views) {
      const auto found = gloss.outgoing(view.point, view.wo, lookup);
      m.missed += found->weight == 0;
      const double d = static_cast<double>(luminance(found->radiance)) - view.truth;
      off += d * d, light += view.truth * view.truth;
    }
    m.error = std::sqrt(off / light);
    return m;
  }
};

TEST(RadianceFootprints, NeedFewerRecordsForTheSameError) {
  const Ground ground;
  ASSERT_GT(ground.views.size(), 80u);
  const Measured discs = ground.measure(Footprint::circle, 0.3),
                 shaped = ground.measure(Footprint::adaptive, 0.3);
  std::printf("%zu discs off by %.2f %%, %zu footprints off by %.2f %%\n", discs.records, 100 * discs.error,
              shaped.records, 100 * shaped.error);
  EXPECT_EQ(shaped.missed, 0);
  EXPECT_LT(static_cast<double>(shaped.records), 0.75 * static_cast<double>(discs.records));
  EXPECT_LT(shaped.error, 0.9 * discs.error);
}

}  // namespace
}  // namespace phos
