// What an environment map costs: made from its texels, sampled, and looked up along rays that leave the
// scene.
//   scene_environment_bench --benchmark_repetitions=5
#include <benchmark/benchmark.h>

#include "core/random.h"
#include "core/sampling.h"
#include "support/environment.h"

namespace phos {
namespace {

constexpr std::uint64_t kCount = 4096;

/// A sky with a sun, so that there is a peak.
Environment map_of_height(std::int64_t height) {
  const int rows = static_cast<int>(height);
  return test::map_of(rows, [&](int x, int y) {
    return Rgb(x == rows / 3 && y == rows / 4 ? 1e8f : 1.f + static_cast<float>(y % 7));
  });
}

std::vector<Vec2> points() {
  std::vector<Vec2> all;
  for (std::uint64_t k = 0; k < kCount; ++k) {
    RandomStream random(1, Stage::test, k);
    all.push_back(random.uniform2());
  }
  return all;
}

void make(benchmark::State& state) {
  const Environment map = map_of_height(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(Environment(map.width(), map.height(), map.texels()));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(map.texels().size()));
}

void sample(benchmark::State& state) {
  const Environment map = map_of_height(state.range(0));
  const std::vector<Vec2> u = points();
  for (auto _ : state) {
    Rgb sum(0);
    for (const Vec2& v : u) {
      const Environment::Sample s = map.sample(v);
      sum += s.luminance * (s.direction.y / s.density);
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kCount));
}

void look_up(benchmark::State& state) {
  const Environment map = map_of_height(state.range(0));
  std::vector<Vec3> directions;
  for (const Vec2& v : points()) directions.push_back(sample_uniform_sphere(v));
  for (auto _ : state) {
    Rgb sum(0);
    for (const Vec3& d : directions) sum += map.luminance(d) * map.density(d);
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kCount));
}

BENCHMARK(make)->Arg(256)->Arg(1024)->Unit(benchmark::kMillisecond);
BENCHMARK(sample)->Arg(256)->Arg(1024);
BENCHMARK(look_up)->Arg(256)->Arg(1024);

}  // namespace
}  // namespace phos
