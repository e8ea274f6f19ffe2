// The cone of a spot light.
#pragma once

#include "scene/scene.h"

namespace phos::inline scene {

/// Sets the cone of a spot light by its half angles in radians. Equal angles are a hard edge. Angles above
/// pi/2 by no more than the rounding of exporters (0.001 rad) are pi/2. Returns false, and sets nothing,
/// unless 0 <= inner <= outer <= pi/2 and outer is above 0.
bool set_spot_cone(Light& light, double inner_rad, double outer_rad);

/// Does the light's intensity fall from its full value to 0 at one angle?
bool has_hard_edge(const Light& light);

}  // namespace phos::inline scene
