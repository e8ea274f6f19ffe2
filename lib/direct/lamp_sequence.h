// Random numbers for lamps, even over the rays of a hemisphere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/random.h"

namespace phos::inline direct {

/// Point k of an additive sequence of three dimensions (R3), each shifted: low discrepancy over the rays of a
/// hemisphere, so that together they see all of the lamps evenly. Of several points to a ray, the first
/// numbers, which choose the lamp, are stratified.
class LampSequence {
 public:
  LampSequence(RandomStream random, std::uint32_t to_a_ray)
      : shift_{random.bits(), random.bits(), random.bits()}, to_a_ray_(to_a_ray) {}
  std::array<float, 3> point(std::size_t ray, std::uint32_t n) const {
    return at(static_cast<std::uint32_t>(ray * to_a_ray_ + n), n);
  }
  /// Another, with nothing in common with that.
  std::array<float, 3> other_point(std::size_t ray, std::uint32_t n) const {
    return at(kUnlike * (static_cast<std::uint32_t>(ray * to_a_ray_ + n) + 1), n);
  }

 private:
  static constexpr std::uint32_t kUnlike = 0x9e3779b1u;

  std::array<float, 3> at(std::uint32_t k, std::uint32_t n) const {
    constexpr std::uint32_t kStep[3] = {0xd1b54a32u, 0xabc98388u,
                                        0x8cb92ba7u};  // 2^32 / 1.2207440846^(d + 1)
    std::array<float, 3> u;
    for (unsigned d = 0; d < 3; ++d) u[d] = static_cast<float>((shift_[d] + k * kStep[d]) >> 8) * 0x1p-24f;
    if (to_a_ray_ > 1) u[0] = (static_cast<float>(n) + u[0]) / static_cast<float>(to_a_ray_);
    return u;
  }

  std::uint32_t shift_[3], to_a_ray_;
};

}  // namespace phos::inline direct
