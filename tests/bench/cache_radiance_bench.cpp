// Radiance records: making one of 4,000 rays and what of that is projection, and lookups of light that
// leaves by a lobe, on a flat surface and on a curved one.
#include <benchmark/benchmark.h>

#include "cache/radiance_gather.h"
#include "core/parallel.h"
#include "support/gathered.h"
#include "support/one_material.h"
#include "support/radiance_records.h"

namespace phos {
namespace {

constexpr std::int64_t kRays = 4000;

struct Ground {
  Scene scene = test::cornell();
  RayScene rays{scene};
  Luminaires lights{scene};
  RecordOptions options = test::gather_options(scene, Quantity::indirect, 1, kRays);
  std::vector<RecordSite> sites;
  Ground() {
    for (std::uint64_t i = 0; sites.size() < 16; ++i) {
      RandomStream random(1, Stage::test, i);
      SurfacePoint point;
      if (trace(rays, {scene.bounds.centre(), sample_uniform_sphere(random.uniform2())}, point))
        sites.push_back({point.position, point.smooth_normal, i});
    }
  }
};
const Ground& ground() {
  static const Ground one;
  return one;
}

/// Per record, by order.
void record(benchmark::State& state) {
  const Ground& g = ground();
  const RadianceEstimator estimator(g.rays, g.lights, {}, g.options, static_cast<int>(state.range(0)),
                                    RadianceGradient::hybrid, 1);
  const auto worker = estimator.make_worker();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(estimator.make(g.sites[i++ % g.sites.size()], *worker));
}
BENCHMARK(record)->Arg(1)->Arg(5)->Arg(10)->Unit(benchmark::kMillisecond);

/// Of a hemisphere that is already there.
void projection(benchmark::State& state, RadianceGradient mode) {
  const Ground& g = ground();
  const RadianceEstimator estimator(g.rays, g.lights, {}, g.options, 1, RadianceGradient::none, 1);
  const auto worker = estimator.make_worker();
  estimator.make(g.sites[0], *worker);
  RadianceProjector projector(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(projector.project(RadianceEstimator::seen(*worker), mode, 1e-3f));
}
BENCHMARK_CAPTURE(projection, analytic, RadianceGradient::analytic)
    ->Arg(5)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projection, hybrid, RadianceGradient::hybrid)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projection, numeric, RadianceGradient::numeric)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projection, none, RadianceGradient::none)->Arg(10)->Unit(benchmark::kMillisecond);

/// 400 records of order 10 over a square metre that is flat, or a cap of a sphere of radius 1 m.
void look_up(benchmark::State& state, bool curved, float exponent) {
  Material m = test::make_material(Model::phong, Rgb(0.1f), Rgb(0.8f));
  m.exponent = exponent;
  Counters counters;
  const BrdfTable table = project_brdf(test::scene_of(m), 0, {}, counters);
  const BrdfLookup brdf(table);
  Bounds bounds;
  bounds.include(Vec3(-0.5f)), bounds.include(Vec3(0.5f));
  RadianceTree tree(bounds, 0.2, 10);
  const auto frame_at = [&](const Vec3& p) {
    return make_frame(curved ? glm::normalize(Vec3(p.x, p.y, 1)) : Vec3(0, 0, 1));
  };
  const auto place = [](RandomStream& random) {
    const Vec2 u = random.uniform2() - 0.5f;
    return Vec3(u, 0);
  };
  for (std::uint64_t i = 0; i < 400; ++i) {
    RandomStream random(1, Stage::test, i);
    const Vec3 p = place(random);
    RadianceRecord r = test::random_radiance(1, 10).records[0];
    r.position = p, r.frame = frame_at(p), r.radius_m = r.distance_m = 0.5f;
    tree.insert(r);
  }
  struct Query {
    Vec3 p;
    Frame frame;
    Vec3 wo;
  };
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    RandomStream random(2, Stage::test, i);
    const Vec3 p = place(random);
    queries.push_back({p, frame_at(p), sample_uniform_cone(random.uniform2(), 0.6f)});
  }
  RadianceTree::Worker worker;
  double records = 0;
  std::size_t i = 0;
  for (auto _ : state) {
    const Query& q = queries[i++ % queries.size()];
    benchmark::DoNotOptimize(tree.outgoing(q.p, q.frame, q.wo, brdf, worker));
    records += static_cast<double>(worker.found.size());
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["records"] = records / static_cast<double>(state.iterations());
  state.counters["order"] = brdf.order(queries[0].wo);
}
BENCHMARK_CAPTURE(look_up, flat_phong_5, false, 5.f);
BENCHMARK_CAPTURE(look_up, flat_phong_22, false, 22.f);
BENCHMARK_CAPTURE(look_up, curved_phong_5, true, 5.f);
BENCHMARK_CAPTURE(look_up, curved_phong_22, true, 22.f);

}  // namespace
}  // namespace phos
