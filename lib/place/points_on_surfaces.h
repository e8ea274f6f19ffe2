// Points that records are asked for, and the surfaces that they lie on.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "file/tool.h"
#include "place/candidates.h"

namespace phos::inline place {

/// Of the typical distance of surroundings (typical_distance_m()): a point this far above or below a surface
/// is meant to lie on it.
inline constexpr float kOnSurface = 1 / 250.f;

struct PointsOnSurfaces {
  std::vector<SurfaceSample>
      points;                ///< in their order; those off a surface by more than rounding are put on it
  std::uint64_t moved = 0;   ///< of them
  std::uint64_t in_air = 0;  ///< left out: no surface within `within_m` along the normal
};
/// A surface is one within 60 degrees of the point's plane. Same result for any number of threads.
PointsOnSurfaces put_on_surfaces(const RayScene& rays, std::span<const SurfaceSample> points, float within_m);

/// The points of the file `path` (--at) that can have a record on a surface. `records` names the records that
/// need a surface, and `instead` the records that do not. Warns of points that are left out; throws
/// Error(bad_input) where none remains.
std::vector<SurfaceSample> require_surfaces(Tool& tool, const RayScene& rays,
                                            std::span<const SurfaceSample> points, float within_m,
                                            const std::string& path, const std::string& records,
                                            const std::string& instead);

}  // namespace phos::inline place
