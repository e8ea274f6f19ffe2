// The hits of one pass of rays over a hemisphere.
#pragma once

#include <cstdint>
#include <span>

#include "core/vector.h"
#include "direct/lamp_sampler.h"
#include "scene/rays.h"

namespace phos::inline estimate {

struct Hemisphere;

/// Light straight from a lamp at a diffuse hit, and the light that the hit then sends on.
struct LampSight {
  ArrivingLight light;
  Rgb brdf{0};            ///< 1/sr
  std::uint32_t hit = 0;  ///< which of the hits
  Rgb arrived{0};         ///< share that arrives, by channel: 0 where something is in the way
};

/// One pass over a hemisphere: the hit of each ray, and the lamps' light there.
struct SeenPass {
  const Hemisphere* hemisphere;
  std::span<const Hit> hits;
  std::span<const LampSight> sights;
};

}  // namespace phos::inline estimate
