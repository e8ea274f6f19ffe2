// A gathered record of 512 rays, and what it costs to look one frame ahead from it: whole,
// or its irradiance alone.
#include <benchmark/benchmark.h>

#include "core/random.h"
#include "support/two_frames.h"
#include "temporal/ahead.h"

namespace phos {
namespace {

const char* const kScenes[] = {"cube-in-a-box", "moving-light", "spheres"};

/// Places that the camera sees in the middle of an animation.
struct Places : test::TwoFrames {
  explicit Places(const std::string& path) : Places(path, load_scene(path).frames / 2) {}
  Places(const std::string& path, std::int64_t frame)
      : TwoFrames(load_frame(path, {}, frame), load_frame(path, {}, frame + 1)),
        options(test::gather_options(scene[0], Quantity::indirect, 1, 512)) {
    const Camera& camera = find_camera(scene[0], "");
    for (std::uint64_t i = 0; sites.size() < 256; ++i) {
      RandomStream random(1, Stage::test, i);
      const Camera::Ray eye = camera.ray(random.uniform2(), camera.aspect);
      SurfacePoint p;
      if (trace(rays[0], {eye.origin, eye.direction}, p)) sites.push_back({p.position, p.smooth_normal, i});
    }
  }
  RecordOptions options;
  std::vector<RecordSite> sites;
};

void look(benchmark::State& state, LookAhead how, bool whole = true) {
  const char* name = kScenes[state.range(0)];
  const Places places(std::string(PHOS_SOURCE) + "/data/" + name + ".glb");
  const auto& [scene, rays, lights, change] = static_cast<const test::TwoFrames&>(places);
  const GatherEstimator now(rays[0], lights[0], {}, places.options, 1),
      next(rays[1], lights[1], {}, places.options, 1);
  const AheadEstimator ahead({now, rays[0], lights[0]}, {next, rays[1], lights[1]}, change, places.options, 1,
                             {.look = how, .most_holes = 1, .whole = whole});
  const auto worker = ahead.make_worker();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(ahead.make(places.sites[i++ % places.sites.size()], *worker));
  state.SetLabel(name);
}

void BM_Record(benchmark::State& state) { look(state, LookAhead::none); }
void BM_RecordAndReproject(benchmark::State& state) { look(state, LookAhead::reproject); }
void BM_RecordAndReprojectLight(benchmark::State& state) { look(state, LookAhead::reproject, false); }
void BM_RecordAndTrace(benchmark::State& state) { look(state, LookAhead::trace); }
BENCHMARK(BM_Record)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_RecordAndReproject)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_RecordAndReprojectLight)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_RecordAndTrace)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace phos
