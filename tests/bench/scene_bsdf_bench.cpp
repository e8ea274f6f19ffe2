// What each reflection model costs: evaluated, sampled with its density, and a measured table read.
//   scene_bsdf_bench --benchmark_filter='evaluate' --benchmark_repetitions=5
#include <benchmark/benchmark.h>

#include "core/random.h"
#include "scene/material/bsdf.h"
#include "support/one_material.h"

namespace phos {
namespace {

constexpr std::uint64_t kDirections = 4096;

std::vector<Vec3> directions(std::uint64_t seed) {
  std::vector<Vec3> all;
  for (std::uint64_t k = 0; k < kDirections; ++k) {
    RandomStream random(seed, Stage::test, k);
    all.push_back(test::direction(0.01f + 0.99f * random.uniform(), 6.2831853f * random.uniform()));
  }
  return all;
}

void evaluate(benchmark::State& state, const Material& material) {
  const Scene scene = test::scene_of(material);
  const Bsdf bsdf(scene, test::flat_point());
  const std::vector<Vec3> wo = directions(1), wi = directions(2);
  for (auto _ : state) {
    Rgb sum(0);
    for (std::size_t k = 0; k < kDirections; ++k) sum += bsdf.evaluate(wo[k], wi[k]);
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kDirections));
}

void sample(benchmark::State& state, const Material& material) {
  const Scene scene = test::scene_of(material);
  const Bsdf bsdf(scene, test::flat_point());
  const std::vector<Vec3> wo = directions(1);
  for (auto _ : state) {
    Rgb sum(0);
    for (std::size_t k = 0; k < kDirections; ++k) {
      RandomStream random(3, Stage::test, k);
      const float u_lobe = random.uniform();
      BsdfSample s;
      if (bsdf.sample(wo[k], u_lobe, random.uniform2(), s)) sum += s.weight;
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kDirections));
}

void read_table(benchmark::State& state) {
  const std::string bytes = test::merl_bytes(test::MirrorLobe{Rgb(0.4f), Rgb(0.5f), 15});
  for (auto _ : state) benchmark::DoNotOptimize(MerlBrdf(bytes, "measured.binary"));
}
BENCHMARK(read_table)->Unit(benchmark::kMillisecond);

const int registered = [] {
  for (const test::Named& named : test::models()) {
    benchmark::RegisterBenchmark(("evaluate/" + named.name).c_str(), evaluate, named.material);
    benchmark::RegisterBenchmark(("sample/" + named.name).c_str(), sample, named.material);
  }
  return 0;
}();

}  // namespace
}  // namespace phos
