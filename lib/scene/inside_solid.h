// Places where no sensor and no camera can be meant.
#pragma once

#include <optional>
#include <string>

#include "scene/rays.h"

namespace phos::inline scene {

/// Is a point inside a solid, or behind the one-sided walls of a room? More than half of the surfaces that
/// eight rays meet are seen from behind. Backs of double-sided surfaces say little, as exporters of building
/// models let the fronts of a room's walls face outwards: where most backs are of that kind, the point is
/// inside of a solid if light cannot get there either, neither from a lamp nor from outside, over 16
/// surfaces.
bool inside_solid(const RayScene& rays, const SurfacePoint& receiver);
/// The solid glass that a point is in: most of the eight rays come to its inside. Null: none.
const Material* glass_about(const RayScene& rays, const SurfacePoint& receiver);
/// Throws Error(bad_input, `where`) that names glass and place where a sensor, unit normal `n`, is in solid
/// glass. Luminance is n2 times as large there as in air, and light that a lamp focuses there lands on no
/// surface: no estimator tells of it.
void require_in_air(const RayScene& rays, const Vec3& p, const Vec3& n, const std::string& where);
/// A line for people where a perspective camera stands in such a place.
std::optional<std::string> camera_inside_solid(const RayScene& rays, const Camera& camera);

}  // namespace phos::inline scene
