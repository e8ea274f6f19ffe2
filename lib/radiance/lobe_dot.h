// The product of a lobe and light.
#pragma once

#include <array>
#include <cstddef>

#include "core/vector.h"

namespace phos::inline radiance {

/// Sum over i of c_i L_i by colour; both hold `n` numbers, RGB side by side.
inline Rgb lobe_dot(const float* c, const float* light, std::size_t n) {
  constexpr std::size_t kLanes = 12;
  std::array<float, kLanes> sum{};
  std::size_t i = 0;
  for (; i + kLanes <= n; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) sum[lane] += c[i + lane] * light[i + lane];
  for (std::size_t lane = 0; i < n; ++i, ++lane) sum[lane] += c[i] * light[i];
  Rgb out(0);
  for (std::size_t lane = 0; lane < kLanes; ++lane) out[static_cast<int>(lane % 3)] += sum[lane];
  return out;
}

}  // namespace phos::inline radiance
