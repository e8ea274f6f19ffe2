// Lookups of indirect light: in the growing tree and in a file's index, with and without the leak test, in
// one thread and in all; opening files of many records; what a sensor costs.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>

#include "core/parallel.h"
#include "record/tree.h"
#include "sense/sensor_table.h"
#include "support/sensors.h"

namespace phos::test {
namespace {

/// `n` records over the walls of a room of 2 x 1 x 1.5 m, each near its neighbours' size apart.
IrradianceCache room_cache(std::size_t n) {
  IrradianceCache cache;
  cache.accuracy = 0.2;
  const Vec3 size(2, 1, 1.5f);
  const float radius_m = 4 * std::sqrt(13.f / static_cast<float>(n));
  for (std::size_t i = 0; i < n; ++i) {
    RandomStream random(1, Stage::test, i);
    IrradianceRecord r;
    r.position = Vec3(random.uniform(), random.uniform(), random.uniform()) * size;
    const auto axis = static_cast<int>(random.bits() % 3);
    const bool high = random.bits() % 2 == 1;
    r.position[axis] = high ? size[axis] : 0;
    r.normal = Vec3(0);
    r.normal[axis] = high ? -1.f : 1.f;
    r.irradiance = Rgb(100), r.stderr_lx = Rgb(1);
    r.radius_m = r.distance_m = radius_m;
    cache.records.push_back(r);
  }
  return cache;
}

struct Room {
  AnalyticScene s = furnace(0.5f, 10);
  RayScene rays{s.scene};
  IrradianceCache cache;
  std::string path;
  explicit Room(std::size_t n) : cache(room_cache(n)), path(scratch(text("lookup", n)) + "/cache") {
    write_irradiance(path, cache, irradiance_provenance());
  }
};
Room& room(std::int64_t n) {
  static std::map<std::int64_t, std::unique_ptr<Room>> rooms;
  auto& s = rooms[n];
  if (!s) s = std::make_unique<Room>(static_cast<std::size_t>(n));
  return *s;
}

/// Looks up near every third record.
template <class Lookup>
void look_up(benchmark::State& state, const Lookup& lookup, const IrradianceCache& cache) {
  constexpr std::size_t kLookups = 20000;
  double found = 0;
  for (auto _ : state) {
    found = parallel_reduce<double>(
        kLookups, 256, 0,
        [&](std::size_t begin, std::size_t end) {
          double sum = 0;
          for (std::size_t i = begin; i < end; ++i) {
            const IrradianceRecord& r = cache.records[i * 7919 % cache.records.size()];
            const Interpolated e =
                lookup.interpolate(r.position + 0.05f * r.radius_m * make_frame(r.normal).x, r.normal);
            sum += e.weight > 0;
          }
          return sum;
        },
        [](double& sum, double part) { sum += part; });
  }
  state.counters["lookups"] =
      benchmark::Counter(static_cast<double>(kLookups * state.iterations()), benchmark::Counter::kIsRate);
  state.counters["served"] = found / kLookups;
}

void tree(benchmark::State& state) {
  Room& s = room(state.range(0));
  set_threads(static_cast<int>(state.range(2)));
  RecordTree tree(s.s.scene.bounds, s.cache.accuracy, state.range(1) ? &s.rays : nullptr);
  for (const IrradianceRecord& r : s.cache.records) tree.insert(r);
  look_up(state, tree, s.cache);
}

void file(benchmark::State& state) {
  Room& s = room(state.range(0));
  set_threads(static_cast<int>(state.range(2)));
  const RecordLookup lookup(Container::open(s.path), state.range(1) ? &s.rays : nullptr);
  look_up(state, lookup, s.cache);
}
#define PHOS_LOOKUPS(f)                                 \
  BENCHMARK(f)                                          \
      ->ArgNames({"records", "leak", "threads"})        \
      ->ArgsProduct({{20000, 1000000}, {0, 1}, {1, 2}}) \
      ->UseRealTime()                                   \
      ->Unit(benchmark::kMillisecond)
PHOS_LOOKUPS(tree);
PHOS_LOOKUPS(file);

void open_file(benchmark::State& state) {
  Room& s = room(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(RecordLookup(Container::open(s.path)));
  state.counters["MB"] = static_cast<double>(std::filesystem::file_size(s.path)) * 1e-6;
}
BENCHMARK(open_file)->ArgName("records")->Arg(20000)->Arg(1000000)->Unit(benchmark::kMillisecond);

/// What opening costs without an index: reading the records and hanging them in a tree.
void read_and_hang(benchmark::State& state) {
  Room& s = room(state.range(0));
  for (auto _ : state) {
    const IrradianceCache cache = read_irradiance(Container::open(s.path));
    benchmark::DoNotOptimize(index_records(cache.records, cache.accuracy));
  }
}
BENCHMARK(read_and_hang)->ArgName("records")->Arg(20000)->Arg(1000000)->Unit(benchmark::kMillisecond);

/// Sensors on the walls, direct light and all, and their table.
void sense(benchmark::State& state) {
  Room& s = room(20000);
  set_threads(static_cast<int>(state.range(1)));
  Sensors sensors;
  for (std::size_t i = 0; i < 20000; ++i) {
    const IrradianceRecord& r = s.cache.records[i];
    sensors.points.push_back({r.position, r.normal});
  }
  const std::vector<Container> files{Container::open(s.path)};
  const Luminaires lights(s.s.scene);
  const SensorCaches caches(files, &s.rays);
  SensorOptions options;
  options.light_samples = state.range(0);
  for (auto _ : state) {
    SensorReport report;
    benchmark::DoNotOptimize(
        sensor_csv(sensors, read_light(sensors, s.rays, lights, caches, options, report)));
  }
  state.counters["sensors"] =
      benchmark::Counter(20000.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(sense)
    ->ArgNames({"light_samples", "threads"})
    ->ArgsProduct({{1, 16, 64}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace phos::test
