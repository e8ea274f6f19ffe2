// Asking for texels before they are looked up.
#pragma once

#include "scene/rays.h"

namespace phos::inline scene {

/// Texels of large textures lie about in memory: this asks for those that the material at a point will read,
/// some points before Bsdf reads them. Changes no result.
void ask_texels(const Scene& scene, const SurfacePoint& point);

}  // namespace phos::inline scene
