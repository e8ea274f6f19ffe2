// Time to splat 4,000 records over a picture of 1000 x 1000, their bounding rectangles covering 0.5 % or 2 %
// of it on average, on the CPU and by OpenGL; and the G-buffer.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "splat/cpu/splatter.h"
#include "splat/gl/kinds.h"
#include "splat/gl/renderer.h"
#include "splat/tiles.h"
#include "support/scenes.h"
#include "support/splat_records.h"

namespace {

using namespace phos;

double mean_coverage(const std::vector<IrradianceRecord>& records, double accuracy, const Camera& camera,
                     int size) {
  double pixels = 0;
  for (const PixelRect& r : record_bounds(records, accuracy, camera, size, size))
    pixels += double(r.x1 - r.x0) * (r.y1 - r.y0);
  return pixels / static_cast<double>(records.size()) / size / size;
}

constexpr int kSize = 1000;
constexpr double kAccuracy = 0.2;

/// 4,000 records, radii spread by a factor of three and scaled until their rectangles cover `coverage` on
/// average.
struct Frame1000 {
  test::AnalyticScene s = test::furnace(0.5f);
  RayScene rays{s.scene};
  Camera camera = s.scene.camera[0];
  GBuffer g = trace_gbuffer(rays, camera, kSize, kSize, {0.5f, 0.5f});
  std::vector<IrradianceRecord> records;

  explicit Frame1000(double coverage) {
    double radius = 0.1 * double(s.scene.bounds.diagonal_m());
    for (int i = 0; i < 20; ++i) {
      records = test::records_in_view(rays, camera, 4000, static_cast<float>(0.5 * radius),
                                      static_cast<float>(1.5 * radius));
      radius *= std::sqrt(coverage / mean_coverage(records, kAccuracy, camera, kSize));
    }
  }
};

double coverage_of(const benchmark::State& state) { return static_cast<double>(state.range(0)) / 1000; }

void splat_cpu(benchmark::State& state) {
  const Frame1000 frame(coverage_of(state));
  set_threads(static_cast<int>(state.range(1)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(splat_on_cpu(frame.records, kAccuracy, frame.g, frame.camera));
  }
  state.counters["coverage_percent"] = 100 * mean_coverage(frame.records, kAccuracy, frame.camera, kSize);
  set_threads(0);
}

/// Of one record almost all is the way of the G-buffer to the driver, and of the sums back.
void splat_gl(benchmark::State& state, GlBy by, std::size_t count) {
  const Frame1000 frame(coverage_of(state));
  choose_gl(by);
  try {
    GlRenderer gl(frame.s.scene);
    const auto records = std::span(frame.records).first(count);
    gl.splat(records.first(1), kAccuracy, frame.g, frame.camera);  // compiles the shaders
    for (auto _ : state) {
      benchmark::DoNotOptimize(gl.splat(records, kAccuracy, frame.g, frame.camera));
    }
    state.SetLabel(gl.description());
  } catch (const NoGl& e) {
    state.SkipWithError(e.what());
  }
}

void gbuffer_traced(benchmark::State& state) {
  const Frame1000 frame(0.02);
  for (auto _ : state) {
    benchmark::DoNotOptimize(trace_gbuffer(frame.rays, frame.camera, kSize, kSize, {0.5f, 0.5f}));
  }
}

void gbuffer_rasterised(benchmark::State& state) {
  const Frame1000 frame(0.02);
  GlRenderer gl(frame.s.scene);
  for (auto _ : state) {
    benchmark::DoNotOptimize(gl.rasterise(frame.camera, kSize, kSize, {0.5f, 0.5f}));
  }
}

// Coverage in thousandths, threads.
BENCHMARK(splat_cpu)
    ->Args({5, 2})
    ->Args({20, 2})
    ->Args({20, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
#define PHOS_SPLAT_GL(by, count)                             \
  BENCHMARK_CAPTURE(splat_gl, by##_##count, GlBy::by, count) \
      ->Arg(5)                                               \
      ->Arg(20)                                              \
      ->Unit(benchmark::kMillisecond)                        \
      ->UseRealTime()
PHOS_SPLAT_GL(osmesa, 1);
PHOS_SPLAT_GL(osmesa, 4000);
PHOS_SPLAT_GL(egl, 1);
PHOS_SPLAT_GL(egl, 4000);
BENCHMARK(gbuffer_traced)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(gbuffer_rasterised)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
