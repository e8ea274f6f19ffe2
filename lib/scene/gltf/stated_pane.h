// Glass as extras.phos of a glTF material states it.
#pragma once

#include "scene/gltf/stated_brdf.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// "tint".
void read_glass(const StatedBrdf& stated, Material& material);
/// Also "transmittance" at normal incidence, a number or three, or "transmittance_by_angle", as glass makers
/// state them.
void read_pane(const StatedBrdf& stated, Material& material);

}  // namespace phos::inline scene
