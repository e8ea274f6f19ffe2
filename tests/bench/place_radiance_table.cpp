// What rays, accuracy and gradients of radiance records cost, and what they bring: the light of glossy
// surfaces towards a camera, from records and from many rays at each of the points. CSV.
//   build/tests/place_radiance_table [SCENE] > radiance.csv
#include <chrono>
#include <cstdio>

#include "estimate/radiance_gather.h"
#include "place/modes.h"
#include "place/radiance_placement.h"
#include "place/two_level.h"
#include "place/view_candidates.h"
#include "radiance/gloss_cache.h"
#include "scene/lamp/luminaires.h"
#include "support/records.h"

namespace {

using namespace phos;

constexpr int kSide = 32;               // points of a picture, each way
constexpr std::int64_t kTruth = 65536;  // rays of each

struct View {
  SurfacePoint point;
  Vec3 wo;
  double truth = 0;
};

struct Ground {
  test::Lit lit;
  const Scene& scene = *lit.scene;
  const RayScene& rays = *lit.rays;
  Luminaires lights{scene};
  Counters counters;
  GlossTables tables{scene, {}, GlossBy::automatic, {}, counters};
  RadianceOptions options = [&] {
    RadianceOptions o;
    o.records.resolve(scene.bounds.diagonal_m() / 4);
    return o;
  }();
  CoarseLevel coarse{rays, lit.photons, options.records, 1};
  std::vector<View> views;

  explicit Ground(const std::string& path) : lit(test::light_up(load_scene(path), 200000)) {
    RadianceOptions many = options;
    many.records.rays = kTruth;
    many.gradients = RadianceGradient::none;
    std::map<int, std::unique_ptr<RadianceEstimator>> estimators;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Vec2 st = (Vec2(i % kSide, i / kSide) + 0.5f) / static_cast<float>(kSide);
      const Camera::Ray eye = scene.camera[0].ray(st, 1);
      View view{{}, -eye.direction};
      const int order =
          trace(rays, {eye.origin, eye.direction}, view.point) ? tables.order(view.point.material) : 0;
      if (order == 0) continue;
      auto& estimator = estimators[order];
      if (!estimator)
        estimator = std::make_unique<RadianceEstimator>(rays, lights, coarse.source(), many.records, order,
                                                        many.gradients, 99);
      const auto worker = estimator->make_worker();
      GlossCache exact(scene.bounds, 0.2, tables);
      exact.insert(
          *estimator
               ->make({view.point.position, view.point.smooth_normal, static_cast<std::uint64_t>(i)}, *worker)
               .radiance);
      GlossCache::Worker lookup;
      view.truth = static_cast<double>(luminance(exact.outgoing(view.point, view.wo, lookup)->radiance));
      views.push_back(view);
    }
  }

  void measure(const char* what, const RadianceOptions& chosen, std::vector<double> read) const {
    RadianceCache cache;
    cache.accuracy = chosen.records.accuracy;
    PlacementOptions placement{.place = Place::view};
    resolve(placement, scene, {}, chosen.records.accuracy);
    Counters events;
    const auto start = std::chrono::steady_clock::now();
    const auto runs = place_radiance(
        cache, tables,
        [&](int order) {
          return std::make_unique<RadianceEstimator>(rays, lights, coarse.source(), chosen.records, order,
                                                     chosen.gradients, 1);
        },
        rays, chosen.records, placement, {}, events);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    double making_s = 0;
    std::uint64_t made = 0;
    for (const RadianceRun& run : runs) making_s += run.report.making_s, made += run.report.made;
    for (const double factor : read) {
      GlossCache gloss(scene.bounds, factor * cache.accuracy, tables);
      for (const RadianceRecord& r : cache.records) gloss.insert(r);
      GlossCache::Worker lookup;
      double off = 0, light = 0, stated = 0;
      int missed = 0;
      for (const View& view : views) {
        const auto found = gloss.outgoing(view.point, view.wo, lookup);
        missed += found->weight == 0;
        if (found->weight == 0) continue;
        const double d = static_cast<double>(luminance(found->radiance)) - view.truth;
        const auto s = static_cast<double>(luminance(found->stderr_cd));
        off += d * d, light += view.truth * view.truth, stated += s * s;
      }
      std::printf("%s,%lld,%g,%g,%zu,%.2f,%.2f,%.3f,%.3f,%d\n", what,
                  static_cast<long long>(chosen.records.rays), cache.accuracy, factor * cache.accuracy,
                  cache.records.size(), seconds, 1e3 * making_s / static_cast<double>(made),
                  100 * std::sqrt(off / light), 100 * std::sqrt(stated / light), missed);
      std::fflush(stdout);
    }
  }
};

}  // namespace

int main(int argc, char** argv) {
  const Ground ground(argc > 1 ? argv[1] : PHOS_SOURCE "/data/cornell-glossy22.glb");
  std::printf(
      "gradients,rays,accuracy,read_with,records,seconds,ms_per_record,error_percent,stated_percent,"
      "missed\n");
  const auto with = [&](std::int64_t rays, double accuracy, RadianceGradient gradients) {
    RadianceOptions o = ground.options;
    o.records.rays = rays, o.records.accuracy = accuracy, o.gradients = gradients;
    return o;
  };
  using enum RadianceGradient;
  for (const std::int64_t rays : {1024, 4096})
    for (const double accuracy : {0.2, 0.3, 0.4})
      ground.measure("hybrid", with(rays, accuracy, hybrid), {1, 1.5, reading_accuracy(accuracy) / accuracy});
  for (const auto& [name, mode] : {std::pair{"analytic", analytic}, std::pair{"none", none}})
    ground.measure(name, with(4096, 0.3, mode), {1, 1.5, reading_accuracy(0.3) / 0.3});
  const double as_read = radiance_reading_accuracy(0.3) / 0.3;
  ground.measure("circle", with(4096, 0.3, hybrid), {as_read});
  for (const double rho : {0.1, 0.2, 0.4}) {
    RadianceOptions shaped = with(4096, 0.3, hybrid);
    shaped.records.footprint = Footprint::adaptive, shaped.records.rho = rho;
    ground.measure(text("rho ", rho).c_str(), shaped, {as_read});
  }
}
