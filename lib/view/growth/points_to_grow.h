// The points at which a walk asks for records, on the surfaces that want records.
#pragma once

#include <span>
#include <vector>

#include "place/candidates.h"
#include "scene/rays.h"

namespace phos::inline view {

/// The points that lie within `beside_m` of a surface along their normals, put on it, in their order. Points
/// of surfaces that do not show the light of records (mirrors, clear glass, lamps that reflect nothing) are
/// left out. Same result for any number of threads.
std::vector<SurfaceSample> points_to_grow(const RayScene& rays, std::span<const SurfaceSample> points,
                                          float beside_m);

}  // namespace phos::inline view
