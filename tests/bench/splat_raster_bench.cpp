// Gautron 2006, table 4.1 (docs/methods.md#r1): root mean square error of irradiance drawn on one plane, for
// each treatment of its border, against gathered rays; and the time of a record. Places are where rays from
// the first camera land.
//   PHOS_RASTER_SCENE=sibenik-flat.glb PHOS_RASTER_PLACES=10000 splat_raster_bench
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <memory>

#include "core/parallel.h"
#include "core/random.h"
#include "estimate/gather.h"
#include "scene/lamp/luminaires.h"
#include "scene/load.h"
#include "scene/rays.h"
#include "splat/raster/hemisphere_raster.h"
#include "support/raster.h"

namespace {

using namespace phos;

struct Places {
  Scene scene;
  std::unique_ptr<RayScene> rays;
  std::unique_ptr<Luminaires> lights;
  std::vector<RecordSite> sites;
  std::vector<double> truth_lx;

  Places() {
    const char* name = std::getenv("PHOS_RASTER_SCENE");
    scene = load_scene(name ? name : PHOS_SOURCE "/data/cornell-measured.glb");
    rays = std::make_unique<RayScene>(scene);
    lights = std::make_unique<Luminaires>(scene);
    const char* count = std::getenv("PHOS_RASTER_PLACES");
    const std::size_t places = count ? std::strtoull(count, nullptr, 10) : 200;
    for (std::uint64_t i = 0; sites.size() < places && i < 10 * places; ++i) {
      RandomStream random(7, Stage::test, i);
      const Camera::Ray ray = scene.camera.at(0).ray(random.uniform2(), 1);
      SurfacePoint point;
      if (trace(*rays, {ray.origin, ray.direction}, point))
        sites.push_back({point.position, point.smooth_normal, i});
    }
    truth_lx.resize(sites.size());
    const GatherEstimator gather(*rays, *lights, {},
                                 test::raster_options(scene, Estimate::gather, RasterBorder::none), 1);
    parallel_chunks(sites.size(), 16, [&](std::size_t begin, std::size_t end) {
      const auto worker = gather.make_worker();
      for (std::size_t i = begin; i < end; ++i)
        truth_lx[i] = static_cast<double>(luminance(gather.make(sites[i], *worker).record.irradiance));
    });
  }
};

const Places& places() {
  static const Places all;
  return all;
}

void raster_border(benchmark::State& state) {
  const Places& p = places();
  const RasterEstimator estimator(
      *p.rays, *p.lights, {},
      test::raster_options(p.scene, Estimate::raster, static_cast<RasterBorder>(state.range(0))), 1);
  const auto worker = estimator.make_worker();
  double absolute = 0, relative = 0, truth = 0;  // sums of squares
  std::size_t lit = 0;
  for (auto _ : state) {
    absolute = relative = truth = 0, lit = 0;
    for (std::size_t i = 0; i < p.sites.size(); ++i) {
      const double e = static_cast<double>(luminance(estimator.make(p.sites[i], *worker).record.irradiance));
      const double t = p.truth_lx[i], off = e - t;
      if (!(t > 0)) continue;
      absolute += off * off, truth += t * t, relative += off * off / (t * t), ++lit;
    }
  }
  const char* const names[] = {"none", "coverage", "stretch"};
  state.SetLabel(names[state.range(0)]);
  // Of the values' own root mean square; and of each place's error relative to its own value.
  state.counters["rms_percent"] = 100 * std::sqrt(absolute / truth);
  state.counters["rms_relative_percent"] = 100 * std::sqrt(relative / static_cast<double>(lit));
  state.counters["records"] =
      benchmark::Counter(static_cast<double>(p.sites.size()), benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(raster_border)->Arg(0)->Arg(1)->Arg(2)->Iterations(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
