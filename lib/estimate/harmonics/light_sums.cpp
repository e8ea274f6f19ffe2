#include "estimate/harmonics/light_sums.h"

#include <algorithm>
#include <cmath>

namespace phos::inline estimate {
namespace {

/// The step to either side by which differences move the place, over the distance of the light's source. They
/// are right to the square of this, and their rounding is 1e-7 of its inverse.
constexpr float kStep = 1.f / 128;

std::size_t count_of(const HarmonicBasis<float>& basis) { return static_cast<std::size_t>(basis.count()); }

void put(float* weights, const Rgb& light) {
  weights[0] = light.x, weights[1] = light.y, weights[2] = light.z;
}

}  // namespace

template <std::size_t kWeights>
void LightSums::Block<kWeights>::clear() {
  x.fill(0), y.fill(0), z.fill(1);
  weight.fill({});
  size = 0;
}

template <std::size_t kWeights>
void LightSums::Block<kWeights>::start(std::size_t count) {
  clear();
  sums.assign(kWeights * count, 0);
}

template <std::size_t kWeights>
std::array<float, kWeights>& LightSums::Block<kWeights>::next(const Vec3& direction) {
  x[size] = direction.x, y[size] = direction.y, z[size] = direction.z;
  return weight[size++];
}

LightSums::LightSums(int order)
    : basis_(order),
      slope_basis_(order + 1),
      slopes_of_(order),
      harmonics_(count_of(slope_basis_) * kLightBlock) {
  start(SlopesBy::none, Falloff::solid);
}

void LightSums::start(SlopesBy slopes, Falloff falloff) {
  slopes_ = slopes, power_ = static_cast<float>(falloff);
  const std::size_t count = count_of(basis_);
  values_.start(count), edges_.start(count), sloped_.start(count_of(slope_basis_));
  light.assign(3 * count, 0);
  for (auto& s : slope) s.assign(3 * count, 0);
}

template <std::size_t kWeights>
void LightSums::flush(const HarmonicBasis<float>& basis, Block<kWeights>& block) {
  if (block.size == 0) return;
  basis.evaluate_batch(BasisKind::hsh, kLightBlock, block.x.data(), block.y.data(), block.z.data(),
                       harmonics_.data());
  const LightKernel& kernel = best_light_kernel();
  (kWeights == 8 ? kernel.of_8 : kernel.of_16)(harmonics_.data(), count_of(basis), block.weight[0].data(),
                                               block.sums.data());
  block.clear();
}

void LightSums::add(const DirectedLight& l) {
  if (slopes_ != SlopesBy::terms) {
    put(values_.next(l.direction).data(), l.value);
    if (values_.size == kLightBlock) flush(basis_, values_);
    if (slopes_ == SlopesBy::differences) add_differences(l);
    return;
  }
  const float p = HshSlopes::p(l.direction.z), q = HshSlopes::q(l.direction.z);
  float* weight = sloped_.next(l.direction).data();
  put(weight, l.value);
  put(weight + 3, (l.normal.x + power_ * l.direction.x) * l.per_m);
  put(weight + 6, (l.normal.y + power_ * l.direction.y) * l.per_m);
  put(weight + 9, p * l.per_m), put(weight + 12, q * l.per_m);
  if (sloped_.size == kLightBlock) flush(slope_basis_, sloped_);
}

/// From a place moved by kStep of a source's distance along an axis, the source lies in another direction,
/// and its light is (1 + step n_a / cos) / (distance ratio)^power times the former light.
void LightSums::add_differences(const DirectedLight& l) {
  for (const int axis : {0, 1}) {
    for (const float step : {kStep, -kStep}) {
      Vec3 w = l.direction;
      w[axis] -= step;
      const float far = glm::length(w);
      const Rgb seen = l.per_m * ((1 + step * l.normal[axis]) / (std::pow(far, power_) * 2 * step));
      add_edge(w / far, axis == 0 ? seen : Rgb(0), axis == 1 ? seen : Rgb(0));
    }
  }
}

void LightSums::add_edge(const Vec3& direction, const Rgb& along_x, const Rgb& along_y) {
  float* weight = edges_.next(direction).data();
  put(weight, along_x), put(weight + 3, along_y);
  if (edges_.size == kLightBlock) flush(basis_, edges_);
}

void LightSums::finish() {
  flush(basis_, values_), flush(basis_, edges_), flush(slope_basis_, sloped_);
  for (std::size_t i = 0; i < count_of(basis_); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      light[3 * i + c] = values_.sums[8 * i + c] + sloped_.sums[16 * i + c];
      for (const std::size_t axis : {0u, 1u})
        slope[axis][3 * i + c] = edges_.sums[8 * i + 3 * axis + c] + sloped_.sums[16 * i + 3 + 3 * axis + c];
    }
  }
  if (slopes_ == SlopesBy::terms)
    slopes_of_.subtract(std::span(sloped_.sums).subspan(9), std::span(sloped_.sums).subspan(12), 16, slope[0],
                        slope[1]);
}

}  // namespace phos::inline estimate
