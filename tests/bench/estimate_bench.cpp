// Cost of one record of about 1,000 photons from a map of 500,000, and of lookups.
#include <benchmark/benchmark.h>

#include "core/parallel.h"
#include "core/random.h"
#include "record/tree.h"
#include "support/records.h"

namespace phos {
namespace {

struct Stage500K {
  Stage500K() : scene(test::cornell()), lit(test::light_up(scene, 260000)), options(test::all_light(scene)) {
    options.min_photons = options.max_photons = 1000;
    for (std::size_t i = 0; i < 512; ++i) {
      rows.push_back(static_cast<std::uint32_t>(RandomStream(1, Stage::test, i).bits() % lit.photons.size()));
    }
  }
  Scene scene;
  test::Lit lit;
  RecordOptions options;
  std::vector<std::uint32_t> rows;
};
Stage500K& stage() {
  static Stage500K s;
  return s;
}

void record(benchmark::State& state) {
  Stage500K& s = stage();
  set_threads(static_cast<int>(state.range(0)));
  const DensityEstimator maker(s.lit.photons, *s.lit.rays, s.options, 1);
  std::uint64_t made = 0;
  for (auto _ : state) {
    parallel_chunks(s.rows.size(), 16, [&](std::size_t begin, std::size_t end) {
      const auto worker = maker.make_worker();
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t row = s.rows[i];
        benchmark::DoNotOptimize(maker.make(
            {s.lit.photons.position[row], decode_octahedral(s.lit.photons.normal[row]), row, row}, *worker));
      }
    });
    made += s.rows.size();
  }
  state.counters["time_per_record"] = benchmark::Counter(
      static_cast<double>(made), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["photons"] = static_cast<double>(s.lit.photons.size());
}
BENCHMARK(record)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void lookup(benchmark::State& state) {
  Stage500K& s = stage();
  IrradianceCache cache;
  Counters counters;
  test::place_at_photons(cache, s.lit.photons, *s.lit.rays, s.options, {.max_candidates = 20000}, 1,
                         counters);
  RecordTree tree(s.scene.bounds, cache.accuracy);
  for (const IrradianceRecord& r : cache.records) tree.insert(r);
  std::size_t i = 0;
  for (auto _ : state) {
    const std::uint32_t row = s.rows[i++ % s.rows.size()];
    benchmark::DoNotOptimize(
        tree.interpolate(s.lit.photons.position[row], decode_octahedral(s.lit.photons.normal[row])));
  }
  state.counters["records"] = static_cast<double>(cache.records.size());
}
BENCHMARK(lookup);

}  // namespace
}  // namespace phos
