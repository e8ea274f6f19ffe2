// Gathered rays per second (of hemispheres and to lamps), against the bound: the very same rays through
// Embree and nothing else.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <filesystem>
#include <memory>

#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "direct/direct_light.h"
#include "estimate/gather.h"
#include "estimate/hit_light.h"
#include "support/records.h"

namespace phos {
namespace {

constexpr std::int64_t kRays = 4096;
constexpr std::size_t kRecords = 64;

/// A scene, places in it, and the rays that gathering sends from them.
struct Ground {
  explicit Ground(Scene s)
      : scene(std::move(s)),
        rays(scene),
        lights(scene),
        options(options_for(scene)),
        gather(rays, lights, {}, options, 1) {
    find_sites();
    log_rays();
  }

  static RecordOptions options_for(const Scene& scene) {
    RecordOptions options;
    options.estimate = Estimate::gather;
    options.gather_bounces = 1;
    options.rays = kRays;
    options.resolve(scene.bounds.diagonal_m() / 4);
    return options;
  }

  /// Where rays from the middle of the scene land.
  void find_sites() {
    for (std::uint64_t i = 0; sites.size() < kRecords && i < 100 * kRecords; ++i) {
      RandomStream random(1, Stage::test, i);
      SurfacePoint point;
      if (trace(rays, {scene.bounds.centre(), sample_uniform_sphere(random.uniform2())}, point))
        sites.push_back({point.position, point.smooth_normal, i});
    }
  }

  void log_rays() {
    const HitLight light(rays, lights, {}, options, 1);
    const auto lit = light.make_worker();
    const auto worker = gather.make_worker();
    Hemisphere h;
    std::vector<Hit> hits;
    for (const RecordSite& site : sites) {
      gather.sample(site, kRays, 0, h, *worker);
      const Vec3 origin = receiver(scene, site.position, site.normal).leave(site.normal);
      hits.assign(h.size(), Hit());
      for (std::size_t i = 0; i < h.size(); ++i) {
        around.push_back({origin, h.direction[i]});
        rays.intersect(around.back(), hits[i]);
      }
      light.shade(origin, hits, site.item, 0, h, *lit);
      for (std::size_t i = 0; i < lit->sight_count; ++i)
        if (!lit->sights[i].light.certain) to_lamps.push_back(lit->sights[i].light.ray);
      around_end.push_back(around.size()), to_lamps_end.push_back(to_lamps.size());
    }
  }
  double ray_count() const { return static_cast<double>(around.size() + to_lamps.size()); }

  Scene scene;
  RayScene rays;
  Luminaires lights;
  RecordOptions options;
  GatherEstimator gather;
  std::vector<RecordSite> sites;
  std::vector<Ray> around, to_lamps;
  std::vector<std::size_t> around_end, to_lamps_end;  // per site
};

const Ground& ground(std::int64_t which) {
  static std::unique_ptr<Ground> all[2];
  auto& one = all[which];
  if (!one)
    one = std::make_unique<Ground>(which == 0 ? test::cornell()
                                              : load_scene(PHOS_SOURCE "/../shared/scenes/sponza-flat.glb"));
  return *one;
}

bool absent(benchmark::State& state) {
  if (state.range(0) == 0 || std::filesystem::exists(PHOS_SOURCE "/../shared/scenes/sponza-flat.glb"))
    return false;
  state.SkipWithError("no ../shared/scenes/sponza-flat.glb");
  return true;
}

void report(benchmark::State& state, const Ground& g) {
  state.counters["rays"] = benchmark::Counter(g.ray_count() * static_cast<double>(state.iterations()),
                                              benchmark::Counter::kIsRate);
  state.counters["to_lamps"] = static_cast<double>(g.to_lamps.size()) / static_cast<double>(g.around.size());
}

void bound(benchmark::State& state) {
  if (absent(state)) return;
  const Ground& g = ground(state.range(0));
  set_threads(static_cast<int>(state.range(1)));
  const auto scene = static_cast<RTCScene>(g.rays.native());
  const auto embree = [](const Ray& ray, RTCRayHit& q) {
    q.ray.org_x = ray.origin.x, q.ray.org_y = ray.origin.y, q.ray.org_z = ray.origin.z;
    q.ray.dir_x = ray.direction.x, q.ray.dir_y = ray.direction.y, q.ray.dir_z = ray.direction.z;
    q.ray.tnear = ray.t_min_m, q.ray.tfar = ray.t_max_m, q.ray.time = 0, q.ray.mask = ~0u, q.ray.id = 0,
    q.ray.flags = 0;
    q.hit.geomID = q.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  };
  for (auto _ : state) {
    parallel_for(g.sites.size(), 1, [&](std::size_t site) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      alignas(16) RTCRayHit query;
      float sum = 0;
      for (std::size_t i = site > 0 ? g.around_end[site - 1] : 0; i < g.around_end[site]; ++i) {
        embree(g.around[i], query);
        rtcIntersect1(scene, &context, &query);
        sum += query.ray.tfar;
      }
      for (std::size_t i = site > 0 ? g.to_lamps_end[site - 1] : 0; i < g.to_lamps_end[site]; ++i) {
        embree(g.to_lamps[i], query);
        rtcOccluded1(scene, &context, &query.ray);
        sum += query.ray.tfar;
      }
      benchmark::DoNotOptimize(sum);
    });
  }
  report(state, g);
}

void gathered(benchmark::State& state) {
  if (absent(state)) return;
  const Ground& g = ground(state.range(0));
  set_threads(static_cast<int>(state.range(1)));
  for (auto _ : state) {
    parallel_for(g.sites.size(), 1, [&](std::size_t site) {
      static thread_local const auto worker = g.gather.make_worker();
      benchmark::DoNotOptimize(g.gather.make(g.sites[site], *worker));
    });
  }
  report(state, g);
}

void scenes_and_threads(benchmark::internal::Benchmark* b) {
  b->ArgNames({"sponza", "threads"});
  for (const int scene : {0, 1})
    for (const int threads : {1, 2}) b->Args({scene, threads});
  b->UseRealTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK(bound)->Apply(scenes_and_threads);
BENCHMARK(gathered)->Apply(scenes_and_threads);

}  // namespace
}  // namespace phos
