#include "cache/light_sums.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace phos {
namespace {

constexpr std::size_t kBlock = LightBlock::kSize;
using RgbRows = LightBlock::RgbRows;

/// Of the distance of what the light comes from: how far differences move the place to either side. They are
/// right to the square of this, and their rounding is 1e-7 of its inverse.
constexpr float kStep = 1.f / 128;

/// Four floats that one instruction takes.
using Lanes = float __attribute__((vector_size(16)));
constexpr std::size_t kLanes = 4;

Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
void add(const Lanes (&lanes)[3], double* sums) {
  for (std::size_t c = 0; c < 3; ++c)
    sums[c] += static_cast<double>((lanes[c][0] + lanes[c][1]) + (lanes[c][2] + lanes[c][3]));
}

/// Adds the sum of harmonic x weight over a block to each colour.
void add_products(const float* harmonic, const RgbRows& weights, double* sums) {
  Lanes sum[3] = {};
  for (std::size_t k = 0; k < kBlock; k += kLanes) {
    const Lanes h = load(harmonic + k);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += h * load(&weights[c][k]);
  }
  add(sum, sums);
}

/// What one harmonic over a block adds to its coefficient and to the slopes of it along x and y: the harmonic
/// weighs `value` and `along`, its own slopes weigh -per_m.
void add_products_and_slopes(const float* harmonic, const float* slope_x, const float* slope_y,
                             const RgbRows& value, const RgbRows (&along)[2], const RgbRows& per_m,
                             double* sums, double* x, double* y) {
  Lanes of_value[3] = {}, of_x[3] = {}, of_y[3] = {};
  for (std::size_t k = 0; k < kBlock; k += kLanes) {
    const Lanes h = load(harmonic + k), hx = load(slope_x + k), hy = load(slope_y + k);
    for (std::size_t c = 0; c < 3; ++c) {
      const Lanes weight = load(&per_m[c][k]);
      of_value[c] += h * load(&value[c][k]);
      of_x[c] += h * load(&along[0][c][k]) - hx * weight;
      of_y[c] += h * load(&along[1][c][k]) - hy * weight;
    }
  }
  add(of_value, sums), add(of_x, x), add(of_y, y);
}

}  // namespace

LightSums::LightSums(int order)
    : basis_(order), count_(static_cast<std::size_t>(basis_.count())), h_(count_ * kBlock), hx_(h_), hy_(h_) {
  clear();
}

void LightSums::clear() {
  light.assign(3 * count_, 0);
  for (auto& s : slope) s.assign(3 * count_, 0);
}

void LightSums::evaluate(const LightBlock::Row& x, const LightBlock::Row& y, const LightBlock::Row& z) {
  basis_.evaluate_batch(BasisKind::hsh, kBlock, x.data(), y.data(), z.data(), h_.data());
}

void LightSums::add_values(const LightBlock& block) {
  evaluate(block.x, block.y, block.z);
  for (std::size_t i = 0; i < count_; ++i) add_products(&h_[i * kBlock], block.value, &light[3 * i]);
}

void LightSums::add_with_slopes(const LightBlock& block, Falloff falloff) {
  basis_.evaluate_batch(BasisKind::hsh, kBlock, block.x.data(), block.y.data(), block.z.data(), h_.data(),
                        hx_.data(), hy_.data(), nullptr);
  const auto power = static_cast<float>(falloff);
  RgbRows along[2];
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < kBlock; ++k) {
      along[0][c][k] = block.per_m[c][k] * (block.normal[0][k] + power * block.x[k]);
      along[1][c][k] = block.per_m[c][k] * (block.normal[1][k] + power * block.y[k]);
    }
  }
  for (std::size_t i = 0; i < count_; ++i)
    add_products_and_slopes(&h_[i * kBlock], &hx_[i * kBlock], &hy_[i * kBlock], block.value, along,
                            block.per_m, &light[3 * i], &slope[0][3 * i], &slope[1][3 * i]);
}

/// From a place moved by kStep of a source's distance along an axis, the source lies in another direction,
/// and its light is (1 + step n_a / cos) / (distance ratio)^power of what it was.
void LightSums::add_with_differences(const LightBlock& block, Falloff falloff) {
  add_values(block);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (const float step : {kStep, -kStep}) {
      LightBlock moved = block;
      for (std::size_t k = 0; k < kBlock; ++k) {
        Vec3 w(block.x[k], block.y[k], block.z[k]);
        w[static_cast<int>(axis)] -= step;
        const float far = glm::length(w);
        moved.set_direction(k, w / far);
        const float ratio = falloff == Falloff::projected ? far * far * far * far : far * far * far;
        const float seen = (1 + step * block.normal[axis][k]) / ratio;
        for (std::size_t c = 0; c < 3; ++c) moved.value[c][k] = block.per_m[c][k] * seen / (2 * step);
      }
      evaluate(moved.x, moved.y, moved.z);
      for (std::size_t i = 0; i < count_; ++i)
        add_products(&h_[i * kBlock], moved.value, &slope[axis][3 * i]);
    }
  }
}

void LightSums::add_edges(const LightEdges& edges) {
  if (edges.size == 0) return;
  evaluate(edges.x, edges.y, edges.z);
  for (std::size_t i = 0; i < count_; ++i)
    for (const std::size_t axis : {0u, 1u})
      add_products(&h_[i * kBlock], edges.along[axis], &slope[axis][3 * i]);
}

}  // namespace phos
