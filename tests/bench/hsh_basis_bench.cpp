// Values of the basis: coefficients per second, scalar and batched, into memory that fits a cache (64
// directions at a time) and into one large table; gradients too.
#include <benchmark/benchmark.h>

#include <vector>

#include "hsh/basis.h"
#include "hsh/quadrature.h"

namespace phos {
namespace {

struct Directions {
  std::vector<float> x, y, z;
  Directions() {
    const Quadrature q = hemisphere_quadrature(64, 64);
    for (std::size_t k = 0; k < q.size(); ++k) {
      x.push_back(static_cast<float>(q.x[k]));
      y.push_back(static_cast<float>(q.y[k]));
      z.push_back(static_cast<float>(q.z[k]));
    }
  }
};

void set_rate(benchmark::State& state, std::size_t coefficients) {
  state.counters["coefficients"] =
      benchmark::Counter(static_cast<double>(coefficients), benchmark::Counter::kIsIterationInvariantRate);
}

void scalar(benchmark::State& state, BasisKind kind) {
  const Directions d;
  const HarmonicBasis<float> basis(static_cast<int>(state.range(0)));
  const std::size_t count = static_cast<std::size_t>(basis.count());
  std::vector<float> out(count);
  for (auto _ : state) {
    for (std::size_t k = 0; k < d.x.size(); ++k) {
      basis.evaluate(kind, d.x[k], d.y[k], d.z[k], out.data());
      benchmark::DoNotOptimize(out.data());
      benchmark::ClobberMemory();
    }
  }
  set_rate(state, count * d.x.size());
}

void with_gradients(benchmark::State& state, BasisKind kind) {
  const Directions d;
  const HarmonicBasis<float> basis(static_cast<int>(state.range(0)));
  const std::size_t count = static_cast<std::size_t>(basis.count());
  std::vector<float> out(count), gx(count), gy(count);
  for (auto _ : state) {
    for (std::size_t k = 0; k < d.x.size(); ++k) {
      basis.evaluate(kind, d.x[k], d.y[k], d.z[k], out.data(), gx.data(), gy.data(), nullptr);
      benchmark::DoNotOptimize(out.data());
      benchmark::ClobberMemory();
    }
  }
  set_rate(state, count * d.x.size());
}

/// `chunk` directions a call, 0: all 4096.
void batched(benchmark::State& state, BasisKind kind, std::size_t chunk) {
  const Directions d;
  if (chunk == 0) chunk = d.x.size();
  const HarmonicBasis<float> basis(static_cast<int>(state.range(0)));
  const std::size_t count = static_cast<std::size_t>(basis.count());
  std::vector<float> out(count * chunk);
  for (auto _ : state) {
    for (std::size_t k = 0; k < d.x.size(); k += chunk) {
      basis.evaluate_batch(kind, chunk, &d.x[k], &d.y[k], &d.z[k], out.data());
      benchmark::DoNotOptimize(out.data());
      benchmark::ClobberMemory();
    }
  }
  set_rate(state, count * d.x.size());
}

void batched_gradients(benchmark::State& state, BasisKind kind) {
  const Directions d;
  constexpr std::size_t kChunk = 64;
  const HarmonicBasis<float> basis(static_cast<int>(state.range(0)));
  const std::size_t count = static_cast<std::size_t>(basis.count());
  std::vector<float> out(count * kChunk), gx(out), gy(out);
  for (auto _ : state) {
    for (std::size_t k = 0; k < d.x.size(); k += kChunk) {
      basis.evaluate_batch(kind, kChunk, &d.x[k], &d.y[k], &d.z[k], out.data(), gx.data(), gy.data(),
                           nullptr);
      benchmark::DoNotOptimize(out.data());
      benchmark::ClobberMemory();
    }
  }
  set_rate(state, count * d.x.size());
}

#define PHOS_ORDERS ->Arg(5)->Arg(10)->Arg(20)
BENCHMARK_CAPTURE(scalar, sh, BasisKind::sh) PHOS_ORDERS;
BENCHMARK_CAPTURE(scalar, hsh, BasisKind::hsh) PHOS_ORDERS;
BENCHMARK_CAPTURE(with_gradients, hsh, BasisKind::hsh) PHOS_ORDERS;
BENCHMARK_CAPTURE(batched, sh_64_at_once, BasisKind::sh, 64) PHOS_ORDERS;
BENCHMARK_CAPTURE(batched, hsh_64_at_once, BasisKind::hsh, 64) PHOS_ORDERS;
BENCHMARK_CAPTURE(batched_gradients, hsh_64_at_once, BasisKind::hsh) PHOS_ORDERS;
BENCHMARK_CAPTURE(batched, hsh_4096_at_once, BasisKind::hsh, 0) PHOS_ORDERS;

}  // namespace
}  // namespace phos
