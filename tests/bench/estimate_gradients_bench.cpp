// Cost of what follows from a hemisphere of rays and from the photons of a zone; per ray or photon.
#include <benchmark/benchmark.h>

#include "support/gradient_scenes.h"

#include "estimate/hemisphere/ray_gradients.h"

namespace phos {
namespace {

Hemisphere hemisphere(std::int64_t rays) {
  RandomStream random(1, Stage::test, 1);
  const int rings = rings_for(rays);
  return test::seen_by_rays(test::gradient_scene("closed_box_5L"), rings, slices_for(rings), random);
}

void of_rays(benchmark::State& state, GradientMode mode) {
  const Hemisphere h = hemisphere(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(ray_gradients(h, mode, 1e-3f));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(h.size()));
}
BENCHMARK_CAPTURE(of_rays, analytic, GradientMode::analytic)->Arg(1024)->Arg(4096);
BENCHMARK_CAPTURE(of_rays, hybrid, GradientMode::hybrid)->Arg(1024)->Arg(4096);
BENCHMARK_CAPTURE(of_rays, ward_heckbert, GradientMode::ward_heckbert)->Arg(1024)->Arg(4096);
BENCHMARK_CAPTURE(of_rays, krivanek, GradientMode::krivanek)->Arg(1024)->Arg(4096);

void value_and_error(benchmark::State& state) {
  const Hemisphere h = hemisphere(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(irradiance_of(h));
    benchmark::DoNotOptimize(standard_error_of(h));
    benchmark::DoNotOptimize(harmonic_distance_m(h));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(h.size()));
}
BENCHMARK(value_and_error)->Arg(1024)->Arg(4096);

void of_photons(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const test::PhotonSource source(test::gradient_scene("closed_box_5L"), 0.2);
  RandomStream random(1, Stage::test, 2);
  ZonePhotons zone;
  source.draw(n, static_cast<double>(n), random, zone);
  const std::vector<std::uint8_t> used(n, 1);
  const ZoneShape shape = disc_shape(0.2);
  for (auto _ : state)
    benchmark::DoNotOptimize(compare_gradients(zone, used, source.area_m2(), Frame(), shape));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(of_photons)->Arg(1000);

}  // namespace
}  // namespace phos
