// Photons stored per second beside the bound that Embree sets, and what the kd-tree costs.
//   photon_bench --benchmark_filter='Sponza' --benchmark_repetitions=5
//   --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <filesystem>
#include <map>
#include <memory>

#include "core/parallel.h"
#include "file/tool.h"
#include "photon/photon_map.h"
#include "photon/trace.h"
#include "photon/tree/kd_tree.h"
#include "scene/load.h"
#include "scene/rays.h"

namespace phos {
namespace {

constexpr std::int64_t kPaths = 200'000;
constexpr std::size_t kRayChunk = 4096;

const std::string kCornell = PHOS_SOURCE "/data/cornell-measured.glb";
const std::string kSponza = PHOS_SOURCE "/../shared/scenes/sponza.glb";

struct Loaded {
  explicit Loaded(const std::string& path) : scene(load_scene(path)), rays(scene) {}
  Scene scene;
  RayScene rays;
};

const Loaded* loaded(const std::string& path) {
  static std::map<std::string, std::unique_ptr<Loaded>> all;
  if (!std::filesystem::exists(path)) return nullptr;
  std::unique_ptr<Loaded>& one = all[path];
  if (!one) one = std::make_unique<Loaded>(path);
  return one.get();
}

Photons traced(const RayScene& rays, std::int64_t paths, PhotonTotals& totals,
               std::vector<Ray>* log = nullptr) {
  PhotonOptions options;
  options.paths = paths;
  Counters counters;
  return trace_photons(rays, options, 0, totals, counters, log);
}

void trace_scene(benchmark::State& state, const std::string& path) {
  const Loaded* s = loaded(path);
  if (!s) return state.SkipWithError("the scene is not there");
  set_threads(static_cast<int>(state.range(0)));
  PhotonTotals totals;
  for (auto _ : state) benchmark::DoNotOptimize(traced(s->rays, kPaths, totals).position.data());
  using benchmark::Counter;
  state.counters["stored/s"] =
      Counter(static_cast<double>(totals.stored), Counter::kIsIterationInvariantRate);
  state.counters["stored"] = static_cast<double>(totals.stored);
}

void intersect_each(RTCScene tree, std::span<const Ray> rays) {
  unsigned sum = 0;
  for (const Ray& r : rays) {
    RTCRayHit hit{};
    hit.ray.org_x = r.origin.x, hit.ray.org_y = r.origin.y, hit.ray.org_z = r.origin.z;
    hit.ray.dir_x = r.direction.x, hit.ray.dir_y = r.direction.y, hit.ray.dir_z = r.direction.z;
    hit.ray.tnear = r.t_min_m, hit.ray.tfar = r.t_max_m, hit.ray.mask = ~0u;
    hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(tree, &context, &hit);
    sum += hit.hit.primID;
  }
  benchmark::DoNotOptimize(sum);
}

/// The same in packets of n rays in their order; those that are left over are left out.
template <std::size_t n, class Packet, class Intersect>
void intersect_packets(RTCScene tree, std::span<const Ray> rays, const Intersect& intersect) {
  unsigned sum = 0;
  alignas(64) int valid[n];
  std::fill(valid, valid + n, -1);
  for (std::size_t first = 0; first + n <= rays.size(); first += n) {
    alignas(64) Packet p{};
    for (std::size_t i = 0; i < n; ++i) {
      const Ray& r = rays[first + i];
      p.ray.org_x[i] = r.origin.x, p.ray.org_y[i] = r.origin.y, p.ray.org_z[i] = r.origin.z;
      p.ray.dir_x[i] = r.direction.x, p.ray.dir_y[i] = r.direction.y, p.ray.dir_z[i] = r.direction.z;
      p.ray.tnear[i] = r.t_min_m, p.ray.tfar[i] = r.t_max_m, p.ray.mask[i] = ~0u;
      p.hit.geomID[i] = p.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    intersect(valid, tree, &context, &p);
    for (const unsigned id : p.hit.primID) sum += id;
  }
  benchmark::DoNotOptimize(sum);
}

/// The rays of trace_scene, in their order, through rtcIntersect1, 4, 8 or 16 and nothing else.
void raw_scene(benchmark::State& state, const std::string& path) {
  const Loaded* s = loaded(path);
  if (!s) return state.SkipWithError("the scene is not there");
  set_threads(static_cast<int>(state.range(0)));
  std::vector<Ray> log;
  PhotonTotals totals;
  traced(s->rays, kPaths, totals, &log);
  const auto tree = static_cast<RTCScene>(s->rays.native());
  for (auto _ : state) {
    parallel_chunks(log.size(), kRayChunk, [&](std::size_t begin, std::size_t end) {
      const std::span<const Ray> rays(log.data() + begin, end - begin);
      switch (state.range(1)) {
        case 4:
          return intersect_packets<4, RTCRayHit4>(tree, rays, rtcIntersect4);
        case 8:
          return intersect_packets<8, RTCRayHit8>(tree, rays, rtcIntersect8);
        case 16:
          return intersect_packets<16, RTCRayHit16>(tree, rays, rtcIntersect16);
        default:
          return intersect_each(tree, rays);
      }
    });
  }
  using benchmark::Counter;
  // As if each ray stored what it stored above: comparable with trace_scene.
  state.counters["stored/s"] =
      Counter(static_cast<double>(totals.stored), Counter::kIsIterationInvariantRate);
  state.counters["rays/s"] = Counter(static_cast<double>(log.size()), Counter::kIsIterationInvariantRate);
}

/// About n photons of the Cornell box.
const Photons& many(std::size_t n) {
  static Photons photons;
  static std::size_t held = 0;
  if (held == n) return photons;
  photons = {};
  PhotonTotals totals;
  const double per_path = static_cast<double>(traced(loaded(kCornell)->rays, 20'000, totals).size()) / 20'000;
  photons =
      traced(loaded(kCornell)->rays, static_cast<std::int64_t>(static_cast<double>(n) / per_path), totals);
  held = n;
  return photons;
}

void map_build(benchmark::State& state) {
  const Photons& source = many(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    state.PauseTiming();
    Photons photons = source;
    state.ResumeTiming();
    benchmark::DoNotOptimize(PhotonMap::build(std::move(photons), {}).size());
  }
  state.counters["photons"] = static_cast<double>(source.size());
}

void map_file(benchmark::State& state, bool save) {
  const std::string path = PHOS_SCRATCH "/bench.photons";
  const Photons& source = many(static_cast<std::size_t>(state.range(0)));
  PhotonTotals totals;
  totals.stored = source.size(), totals.emitted = totals.paths = source.size();
  const PhotonMap map = PhotonMap::build(source, totals);
  Provenance provenance;
  provenance.tool = "photon_bench";
  map.write(path, provenance);
  for (auto _ : state) {
    if (save)
      map.write(path, provenance);
    else
      benchmark::DoNotOptimize(PhotonMap::open(path).size());
  }
  state.counters["photons"] = static_cast<double>(source.size());
  state.counters["bytes/photon"] =
      static_cast<double>(std::filesystem::file_size(path)) / static_cast<double>(source.size());
  std::filesystem::remove(path);
}

void map_query(benchmark::State& state) {
  const PhotonMap map = PhotonMap::build(many(500'000), {});
  const auto k = static_cast<std::size_t>(state.range(0));
  std::vector<std::uint32_t> rows;
  std::vector<float> d2;
  map.nearest(map.position[map.size() / 3], k, rows, d2);
  const float radius_m = std::sqrt(d2.back());
  std::size_t i = 0;
  for (auto _ : state) {
    map.in_sphere(map.position[i], radius_m, rows);
    benchmark::DoNotOptimize(rows.data());
    i = (i + 7919) % map.size();
  }
}

const int kRegistered = [] {
  using benchmark::RegisterBenchmark;
  for (const auto& [name, path] : {std::pair{"Cornell", kCornell}, std::pair{"Sponza", kSponza}}) {
    RegisterBenchmark((std::string(name) + "/trace").c_str(),
                      [path = path](benchmark::State& s) { trace_scene(s, path); })
        ->Arg(1)
        ->Arg(2)
        ->ArgName("threads")
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
    RegisterBenchmark((std::string(name) + "/raw").c_str(),
                      [path = path](benchmark::State& s) { raw_scene(s, path); })
        ->ArgsProduct({{1, 2}, {1, 4, 8, 16}})
        ->ArgNames({"threads", "rays"})
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  }
  for (const std::int64_t n : {500'000, 5'000'000, 20'000'000}) {
    RegisterBenchmark("map/build", map_build)
        ->Arg(n)
        ->Iterations(1)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
    for (const bool save : {true, false})
      RegisterBenchmark(save ? "map/save" : "map/open", [save](benchmark::State& s) { map_file(s, save); })
          ->Arg(n)
          ->Iterations(1)
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
  }
  RegisterBenchmark("map/in_sphere", map_query)
      ->Arg(50)
      ->Arg(1000)
      ->Arg(10000)
      ->Unit(benchmark::kMicrosecond);
  return 0;
}();

}  // namespace
}  // namespace phos
