// Time to draw 869 radiance records (and 3,023 of irradiance) over a picture of the glossy Cornell box, 1000
// x 1000, on the CPU and by OpenGL: the figures of Gautron et al. 2004's scene.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/parallel.h"
#include "splat/cpu/splatter.h"
#include "splat/gl/renderer.h"
#include "support/gloss_scenes.h"
#include "support/splat_records.h"

namespace {

using namespace phos;

constexpr int kSize = 1000;
constexpr double kAccuracy = 0.25;
constexpr std::size_t kRadiance = 869, kIrradiance = 3023;
constexpr Vec2 kMiddle(0.5f, 0.5f);

/// Lobes of order 10 (tables that leave out less), and records whose zones overlap about 8 times on the wall.
struct Box {
  Scene scene = test::glossy_cornell();
  RayScene rays{scene};
  Camera camera = scene.camera.at(0);
  GBuffer g = trace_gbuffer(rays, camera, kSize, kSize, kMiddle);
  GlossTables tables = [&] {
    Counters counters;
    BrdfTableOptions options;
    options.error = 0.025;
    return GlossTables(scene, {}, GlossBy::automatic, options, counters);
  }();
  // Each lights a disc of accuracy x radius.
  float radius_m = static_cast<float>(std::sqrt(8 * 0.556 * 0.549 / (kRadiance * 3.14159)) / kAccuracy);
  GlossCache cache = test::gloss_cache(
      rays, tables, kAccuracy,
      test::radiance_in_view(rays, tables, camera, kRadiance, 0.7f * radius_m, 1.3f * radius_m));
  std::vector<IrradianceRecord> irradiance =
      test::records_in_view(rays, camera, kIrradiance, 0.5f * radius_m, radius_m);
};

void tell(benchmark::State& state, const Box& box, const GlossBuffer& drawn) {
  std::size_t pixels = 0;
  for (const Vec4& v : drawn.light) pixels += v.w > 0;
  state.counters["order"] = box.tables.orders().back();
  state.counters["pairs"] = static_cast<double>(drawn.pairs);
  state.counters["pixels"] = static_cast<double>(pixels);
}

void gloss_cpu(benchmark::State& state) {
  const Box box;
  set_threads(static_cast<int>(state.range(0)));
  GlossBuffer drawn;
  for (auto _ : state) drawn = splat_gloss_on_cpu(box.cache, kAccuracy, box.rays, box.g, box.camera, kMiddle);
  tell(state, box, drawn);
  set_threads(0);
}

void gloss_looked_up(benchmark::State& state) {
  const Box box;
  GlossBuffer drawn;
  for (auto _ : state) drawn = look_up_gloss(box.cache, box.rays, box.g, box.camera, kMiddle);
  tell(state, box, drawn);
}

void gloss_gl(benchmark::State& state) {
  const Box box;
  GlRenderer gl(box.scene);
  GlossBuffer drawn = gl.splat_gloss(box.cache, kAccuracy, box.rays, box.g, box.camera, kMiddle);
  for (auto _ : state) drawn = gl.splat_gloss(box.cache, kAccuracy, box.rays, box.g, box.camera, kMiddle);
  tell(state, box, drawn);
}

void irradiance_cpu(benchmark::State& state) {
  const Box box;
  for (auto _ : state) benchmark::DoNotOptimize(splat_on_cpu(box.irradiance, kAccuracy, box.g, box.camera));
}

void irradiance_gl(benchmark::State& state) {
  const Box box;
  GlRenderer gl(box.scene);
  gl.splat(std::span(box.irradiance).first(1), kAccuracy, box.g, box.camera);
  for (auto _ : state) benchmark::DoNotOptimize(gl.splat(box.irradiance, kAccuracy, box.g, box.camera));
}

BENCHMARK(gloss_cpu)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(gloss_looked_up)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(gloss_gl)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(irradiance_cpu)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(irradiance_gl)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
