// Rotations of hemispherical harmonics: from the tables, one and three channels, by method made anew for each
// rotation; about z alone; SH, and from SH to HSH; making of the tables.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "hsh/conversion.h"
#include "hsh/rotation.h"
#include "hsh/turn/hsh_turn.h"

namespace phos {
namespace {

std::vector<float> random_coefficients(int order, int channels) {
  RandomStream random(1, Stage::test, 1);
  std::vector<float> c(static_cast<std::size_t>(harmonic_count(order) * channels));
  for (float& x : c) x = random.uniform() - 0.5f;
  return c;
}

/// Rotations of all kinds up to `degrees`.
std::vector<ZyzAngles> random_angles(float degrees) {
  std::vector<ZyzAngles> angles(4096);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    RandomStream random(2, Stage::test, i);
    angles[i].alpha = 2 * kPi * random.uniform(), angles[i].gamma = 2 * kPi * random.uniform();
    angles[i].beta = (0.1f + (degrees - 0.1f) * random.uniform()) * kPi / 180;
  }
  return angles;
}

void rotate(benchmark::State& state, int channels) {
  const auto order = static_cast<int>(state.range(0));
  const HshRotator rotator(order);
  const std::vector<ZyzAngles> angles = random_angles(static_cast<float>(state.range(1)));
  const std::vector<float> in = random_coefficients(order, channels);
  std::vector<float> out(in.size());
  for (const ZyzAngles& a : angles) rotator.rotate(a, in, out, channels);  // makes the tables
  std::size_t i = 0;
  for (auto _ : state) {
    rotator.rotate(angles[i++ % angles.size()], in, out, channels);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations());
}
void BM_Rotate(benchmark::State& state) { rotate(state, 1); }
void BM_RotateRgb(benchmark::State& state) { rotate(state, 3); }
BENCHMARK(BM_Rotate)->ArgNames({"order", "degrees"})->ArgsProduct({{5, 7, 10, 20}, {20}})->Args({10, 1});
BENCHMARK(BM_RotateRgb)->ArgNames({"order", "degrees"})->ArgsProduct({{5, 7, 10, 20}, {20}})->Args({10, 1});

void BM_RotateAboutZ(benchmark::State& state) {
  std::vector<float> c = random_coefficients(static_cast<int>(state.range(0)), 1);
  for (auto _ : state) {
    rotate_about_z(c, 0.7f);
    benchmark::DoNotOptimize(c.data());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_RotateAboutZ)->ArgName("order")->Arg(5)->Arg(10)->Arg(20);

void BM_RotateSh(benchmark::State& state) {
  const auto order = static_cast<int>(state.range(0));
  const std::vector<float> in = random_coefficients(order, 3);
  std::vector<float> out(in.size());
  const ShRotation rotation(order, {1, 0.3f, 2});
  for (auto _ : state) {
    rotation.rotate(in, out, 3);
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_RotateSh)->ArgName("order")->Arg(10)->Arg(20);

void BM_MakeShRotation(benchmark::State& state) {
  const std::vector<ZyzAngles> angles = random_angles(90);
  std::size_t i = 0;
  for (auto _ : state) {
    const ShRotation rotation(static_cast<int>(state.range(0)), angles[i++ % angles.size()]);
    benchmark::DoNotOptimize(&rotation);
  }
}
BENCHMARK(BM_MakeShRotation)->ArgName("order")->Arg(10)->Arg(20);

void BM_ShToHsh(benchmark::State& state) {
  const auto order = static_cast<int>(state.range(0));
  const HarmonicConversion conversion(order, 2 * order);
  const std::vector<float> sh = random_coefficients(2 * order, 3);
  std::vector<float> hsh(static_cast<std::size_t>(harmonic_count(order) * 3));
  for (auto _ : state) {
    conversion.sh_to_hsh(sh, hsh, 3);
    benchmark::DoNotOptimize(hsh.data());
  }
}
BENCHMARK(BM_ShToHsh)->ArgName("order")->Arg(5)->Arg(10);

/// To SH of twice the order, their rotation made anew, and back.
void BM_RotateThroughSh(benchmark::State& state) {
  const auto order = static_cast<int>(state.range(0));
  const HarmonicConversion conversion(order, 2 * order);
  const std::vector<ZyzAngles> angles = random_angles(20);
  const std::vector<float> in = random_coefficients(order, 1);
  std::vector<float> out(in.size()), sh(static_cast<std::size_t>(harmonic_count(2 * order))),
      turned(sh.size());
  std::size_t i = 0;
  for (auto _ : state) {
    conversion.hsh_to_sh(in, sh);
    ShRotation(2 * order, angles[i++ % angles.size()]).rotate(sh, turned);
    conversion.sh_to_hsh(turned, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_RotateThroughSh)->ArgName("order")->Arg(5)->Arg(10);

/// A table of one angle; the rotator has one of each whole degree that it meets.
void BM_MakeTable(benchmark::State& state) {
  const auto order = static_cast<int>(state.range(0));
  const auto method = static_cast<HshRotation>(state.range(1));
  double degrees = 0;
  for (auto _ : state) {
    degrees = degrees < 31 ? degrees + 1 : 1;
    const Turn turn = hsh_turn(order, method, degrees * std::numbers::pi / 180);
    benchmark::DoNotOptimize(turn.cosine.data());
  }
}
BENCHMARK(BM_MakeTable)
    ->ArgNames({"order", "method"})
    ->ArgsProduct({{10}, {0, 1, 2, 3, 4}})
    ->Args({5, 3})
    ->Args({20, 3})
    ->Args({30, 3})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace phos
