// Tables of glossy reflection: making one, and reading it.
#include <benchmark/benchmark.h>

#include "core/parallel.h"
#include "radiance/brdf/lobe_projection.h"
#include "radiance/brdf/projection.h"
#include "radiance/brdf/table.h"
#include "support/one_material.h"
#include "support/reflections.h"

namespace phos {
namespace {

Material phong22() {
  Material m = test::make_material(Model::phong, Rgb(0), Rgb(0.8f));
  m.exponent = 22;
  return m;
}
Material conductor() { return test::make_material(Model::conductor, Rgb(0), Rgb(1, 0.7f, 0.3f), 0.3f, 0.3f); }
Material ward() { return test::make_material(Model::ward, Rgb(0), Rgb(0.8f), 0.2f, 0.5f); }
Material anisotropic_conductor() {
  return test::make_material(Model::conductor, Rgb(0), Rgb(1, 0.7f, 0.3f), 0.2f, 0.5f);
}
Material plastic() { return test::make_material(Model::plastic, Rgb(0.5f), Rgb(0), 0.3f, 0.3f); }
Material measured() {
  Material m;
  m.model = Model::measured, m.measured = test::kMeasuredMirrorLobe;
  return m;
}

/// One material on 32 x 32 directions (or 32 angles where isotropic) at order 10; threads as the machine has.
void project_material(benchmark::State& state, const Material& material) {
  const Scene scene = test::scene_of(material);
  set_threads(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    Counters counters;
    benchmark::DoNotOptimize(project_brdf(scene, 0, {}, counters).order);
  }
  set_threads(0);
}
#define PHOS_PROJECT(material)                              \
  BENCHMARK_CAPTURE(project_material, material, material()) \
      ->Arg(1)                                              \
      ->Arg(2)                                              \
      ->Unit(benchmark::kMillisecond)                       \
      ->UseRealTime()
PHOS_PROJECT(phong22);
PHOS_PROJECT(conductor);
PHOS_PROJECT(plastic);
PHOS_PROJECT(measured);
PHOS_PROJECT(ward);
PHOS_PROJECT(anisotropic_conductor);

/// One direction: the points of its lobe, and its coefficients.
void place_points(benchmark::State& state) {
  const Vec3 wo = test::view(40, 20);
  const auto f = test::bounded_ward_reflection(0.2f, 0.5f, wo);
  std::size_t points = 0;
  for (auto _ : state) points = lobe_points(f, test::mirror_of(wo), 10).size();
  state.counters["points"] = static_cast<double>(points);
}
BENCHMARK(place_points)->Unit(benchmark::kMicrosecond);

void project_one(benchmark::State& state) {
  const Vec3 wo = test::view(40, 20);
  const auto f = test::bounded_ward_reflection(0.2f, 0.5f, wo);
  const HarmonicBasis<float> basis(10);
  for (auto _ : state) benchmark::DoNotOptimize(project_lobe(f, test::mirror_of(wo), basis).energy);
}
BENCHMARK(project_one)->Unit(benchmark::kMicrosecond);

void look_up(benchmark::State& state, const Material& material) {
  const Scene scene = test::scene_of(material);
  Counters counters;
  const BrdfTable table = project_brdf(scene, 0, {}, counters);
  const BrdfLookup lookup(table);
  const std::vector<float> light(3 * 100, 1.f);
  const Vec3 wo = test::view(30, 77);
  state.counters["order"] = lookup.order(wo);
  for (auto _ : state) benchmark::DoNotOptimize(lookup.outgoing(wo, light));
}
BENCHMARK_CAPTURE(look_up, isotropic, phong22());
BENCHMARK_CAPTURE(look_up, anisotropic, ward());

}  // namespace
}  // namespace phos
