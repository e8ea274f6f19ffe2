// Light straight from the lamps where rays land, had without shadow rays.
#pragma once

#include <cstdint>

#include "core/vector.h"

namespace phos::inline scene {
struct SurfacePoint;
}

namespace phos::inline estimate {

/// Const, usable from any thread.
class LampLight {
 public:
  virtual ~LampLight() = default;
  /// Light of all lamps together that arrives on the seen side of a point, lx. Lamps with an area may be
  /// asked for one of their places alone: `turn` numbers the points that are asked together, and chooses it.
  virtual Rgb lux(const SurfacePoint& point, std::uint32_t turn) const = 0;
};

}  // namespace phos::inline estimate
