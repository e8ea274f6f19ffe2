// A lookup on a parallel surface not far below must be able to tell that a record lies in front of it.
#pragma once

#include "scene/rays.h"

namespace phos::inline estimate {

/// Of a record's radius: how far below its place a parallel surface must lie for lookups to tell the two
/// apart (record_apart allows half of it).
inline constexpr float kNextSurface = 0.02f;

/// Height of p over the next surface against its unit normal n, m; infinity where none lies within
/// (least_m, kNextSurface x radius_m). `least_m` keeps clear of p's own surface.
float height_over_next_m(const RayScene& rays, const Vec3& p, const Vec3& n, float least_m, float radius_m);

}  // namespace phos::inline estimate
