// The time of a record by drawing the hemisphere beside the time of rays of equal error, irradiance (0) and
// radiance of 6 bands (1), for sides of the plane, lit by shadow rays (0) and by shadow maps (1):
//   PHOS_RASTER_SCENE=sibenik-flat.glb PHOS_RASTER_PLACES=100 splat_raster_record_bench
// rms_percent: of the values' own root mean square, against 8192 rays, first bounce. rays_equal: how many
// rays have that error, between the settings 12, 27, 52 ... that were measured; ms_rays: their time;
// cpu_ms_: the same by the processor's clock (without a GPU's time). One thread, but for OpenGL's own.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <vector>

#include "core/random.h"
#include "estimate/gather.h"
#include "estimate/radiance_gather.h"
#include "scene/lamp/luminaires.h"
#include "scene/load.h"
#include "scene/rays.h"
#include "splat/raster/hemisphere_raster.h"
#include "splat/raster/radiance_raster.h"
#include "support/raster.h"

namespace {

using namespace phos;

constexpr int kOrder = 6;
constexpr std::int64_t kRays[] = {12, 27, 52, 108, 208, 432, 864, 1728, 3456};

/// Values of a place: irradiance, or coefficients.
std::vector<double> values_of(const Made& made) {
  if (!made.radiance) return {static_cast<double>(luminance(made.record.irradiance))};
  std::vector<double> values;
  const std::vector<float>& light = made.radiance->light;
  for (std::size_t i = 1; i < light.size(); i += 3) values.push_back(static_cast<double>(light[i]));
  return values;
}

struct Cost {
  double error = 0, ms = 0, cpu_ms = 0;  // relative; of a record
};

/// Places of one kind of records, and what rays cost there.
struct Places {
  bool of_radiance;
  Scene scene;
  std::unique_ptr<RayScene> rays;
  std::unique_ptr<Luminaires> lights;
  std::vector<RecordSite> sites;
  std::vector<std::vector<double>> truth;
  std::vector<Cost> ladder;  // of kRays

  explicit Places(bool radiance) : of_radiance(radiance) {
    const char* name = std::getenv("PHOS_RASTER_SCENE");
    scene = load_scene(name ? name : PHOS_SOURCE "/data/cornell-measured.glb");
    rays = std::make_unique<RayScene>(scene);
    lights = std::make_unique<Luminaires>(scene);
    const char* count = std::getenv("PHOS_RASTER_PLACES");
    const std::size_t places = count ? std::strtoull(count, nullptr, 10) : 100;
    for (std::uint64_t i = 0; sites.size() < places && i < 10 * places; ++i) {
      RandomStream random(7, Stage::test, i);
      const Camera::Ray ray = scene.camera.at(0).ray(random.uniform2(), 1);
      SurfacePoint point;
      if (trace(*rays, {ray.origin, ray.direction}, point))
        sites.push_back({point.position, point.smooth_normal, i});
    }
    const RecordOptions judge = test::raster_options(scene, Estimate::gather);
    const auto estimator = gather(judge, 2);
    const auto worker = estimator->make_worker();
    for (const RecordSite& site : sites) truth.push_back(values_of(estimator->make(site, *worker)));
    for (const std::int64_t n : kRays) {
      RecordOptions options = judge;
      options.rays = n;
      ladder.push_back(cost_of(*gather(options, 1)));
    }
  }

  std::unique_ptr<Estimator> gather(const RecordOptions& o, std::uint64_t seed) const {
    if (!of_radiance) return std::make_unique<GatherEstimator>(*rays, *lights, GatherSource(), o, seed);
    return std::make_unique<RadianceEstimator>(*rays, *lights, GatherSource(), o, kOrder,
                                               RadianceGradient::hybrid, seed);
  }
  std::unique_ptr<Estimator> raster(const RecordOptions& o) const {
    if (!of_radiance) return std::make_unique<RasterEstimator>(*rays, *lights, GatherSource(), o, 1);
    return std::make_unique<RadianceRasterEstimator>(*rays, *lights, GatherSource(), o, kOrder,
                                                     RadianceGradient::hybrid, 1);
  }

  Cost cost_of(const Estimator& estimator) const {
    const auto worker = estimator.make_worker();
    estimator.make(sites.front(), *worker);  // memory is there
    std::vector<std::vector<double>> found;
    const std::clock_t cpu = std::clock();
    const auto start = std::chrono::steady_clock::now();
    for (const RecordSite& site : sites) found.push_back(values_of(estimator.make(site, *worker)));
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    const double cpu_ms = 1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    const auto n = static_cast<double>(sites.size());
    double off = 0, all = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      for (std::size_t k = 0; k < found[i].size(); ++k)
        off += std::pow(found[i][k] - truth[i][k], 2), all += truth[i][k] * truth[i][k];
    return {std::sqrt(off / all), time.count() / n, cpu_ms / n};
  }

  struct Rays {
    double count = 0, ms = 0, cpu_ms = 0;
  };
  /// Rays of that error and their time, straight between settings in logarithms; the nearest beyond them.
  Rays rays_of(double error) const {
    for (std::size_t i = 1; i < ladder.size(); ++i) {
      const Cost &a = ladder[i - 1], &b = ladder[i];
      if (error < b.error && i + 1 < ladder.size()) continue;
      const double t = std::clamp(std::log(a.error / error) / std::log(a.error / b.error), 0.0, 1.0);
      const auto between = [&](double x, double y) { return x * std::pow(y / x, t); };
      return {between(static_cast<double>(kRays[i - 1]), static_cast<double>(kRays[i])), between(a.ms, b.ms),
              between(a.cpu_ms, b.cpu_ms)};
    }
    return {};
  }
};

const Places& places(bool radiance) {
  static const Places irradiance(false), of_radiance(true);
  return radiance ? of_radiance : irradiance;
}

void drawn_record(benchmark::State& state) {
  const Places& p = places(state.range(0) != 0);
  RecordOptions options = test::raster_options(p.scene, Estimate::raster);
  options.raster_side = state.range(1);
  options.raster_light = state.range(2) != 0 ? RasterLight::shadow_map : RasterLight::traced;
  const auto estimator = p.raster(options);
  Cost cost;
  for (auto _ : state) cost = p.cost_of(*estimator);
  const Places::Rays rays = p.rays_of(cost.error);
  state.counters["rms_percent"] = 100 * cost.error;
  state.counters["ms_record"] = cost.ms;
  state.counters["cpu_ms_record"] = cost.cpu_ms;
  state.counters["rays_equal"] = rays.count;
  state.counters["ms_rays"] = rays.ms;
  state.counters["cpu_ms_rays"] = rays.cpu_ms;
}

BENCHMARK(drawn_record)
    ->ArgNames({"radiance", "side", "maps"})
    ->ArgsProduct({{0, 1}, {8, 16, 32, 64}, {0, 1}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
