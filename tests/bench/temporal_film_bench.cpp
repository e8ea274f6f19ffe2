// What a film costs each frame: the cache that it is then, from memory and from its file.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "support/films.h"

#include "temporal/film/file.h"

namespace phos::test {
namespace {

constexpr auto kGradients = TemporalGradients::interpolated;

void BM_CacheAt(benchmark::State& state) {
  const Film film = random_film(static_cast<std::size_t>(state.range(0)), true, kGradients);
  const Scene scene = one_triangle();
  std::size_t alive = 0;
  for (auto _ : state) alive = cache_at(film, 14, scene).records.size();
  state.counters["alive"] = static_cast<double>(alive);
}
BENCHMARK(BM_CacheAt)->Arg(300'000)->Unit(benchmark::kMillisecond);

/// `verified`: the second frame and those after it. `at_frame`: what is alive alone.
template <bool verified, bool at_frame>
void BM_RadianceFile(benchmark::State& state) {
  const std::string folder = scratch("film_bench"), path = folder + "/film.radiance";
  write_film(path, random_radiance_film(std::vector<int>(20'000, 8), false, kGradients),
             radiance_provenance());
  const Scene scene = one_triangle();
  Container file = Container::open(path);
  for (auto _ : state) {
    if (!verified) file = Container::open(path);
    const RadianceCache cache =
        at_frame ? read_radiance_film_at(file, 14, scene) : cache_at(read_radiance_film(file), 14, scene);
    benchmark::DoNotOptimize(cache.records.data());
  }
  std::filesystem::remove_all(folder);
}
BENCHMARK(BM_RadianceFile<false, false>)->Name("BM_RadianceFile/all/first")->Unit(benchmark::kMillisecond);
BENCHMARK(BM_RadianceFile<false, true>)->Name("BM_RadianceFile/alive/first")->Unit(benchmark::kMillisecond);
BENCHMARK(BM_RadianceFile<true, true>)->Name("BM_RadianceFile/alive/next")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace phos::test
