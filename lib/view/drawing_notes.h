// What the page draws otherwise than it is.
#pragma once

#include <string>
#include <vector>

#include "radiance/gloss_cache.h"
#include "record/irradiance_cache.h"
#include "scene/rays.h"

namespace phos::inline view {

/// Approximations of the drawing that apply to a scene, for the page and the terminal. `gloss`: the radiance
/// records, or null. Readings under the cursor have none of these approximations.
std::vector<std::string> drawing_notes(const RayScene& rays, const IrradianceCache& cache,
                                       const GlossCache* gloss);

}  // namespace phos::inline view
