// The box about places within rooms, through whose faces they see the sky.
#pragma once

#include <span>
#include <utility>

#include "scene/opening/lookers.h"
#include "scene/opening/portal.h"

namespace phos::inline scene {

/// About the lookers, a little wider; there must be some.
Bounds box_about(std::span<const Looker> lookers);
/// Face 2 * axis + (1 for the upper) of a box, inwards.
Portal face_of(const Bounds& box, int face);
/// The face at which a ray from within leaves the box, and the place on it.
std::pair<int, Vec3> way_out(const Bounds& box, const Vec3& from, const Vec3& direction);

}  // namespace phos::inline scene
