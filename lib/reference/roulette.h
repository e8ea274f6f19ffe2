// Where paths of the reference end.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/random.h"
#include "core/vector.h"

namespace phos::inline reference {

/// Russian roulette from this scattering on (3 to 5 measured best in variance x time, in a box and in an
/// atrium). Survival stays below 1, so that paths end where nothing absorbs.
inline constexpr std::int64_t kRouletteFrom = 4;
inline constexpr float kMostSurvival = 0.999f;
/// The bounce of the numbers that a path starts with.
inline constexpr std::uint32_t kStartBounce = 0xffff;

/// False: the path ends. Else `throughput` is divided by the chance to go on, which is `share`, the part of
/// its light that is left.
inline bool survives(std::int64_t scatterings, float share, RandomStream& random, Rgb& throughput) {
  if (scatterings < kRouletteFrom) return true;
  const float survival = std::min(kMostSurvival, share);
  if (!(random.uniform() < survival)) return false;
  throughput /= survival;
  return true;
}

}  // namespace phos::inline reference
