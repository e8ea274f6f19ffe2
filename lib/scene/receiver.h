// A place that light is asked for at.
#pragma once

#include "scene/rays.h"

namespace phos::inline scene {

/// The point at p that faces n (unit), lifted off surfaces by the rounding of positions in this scene.
SurfacePoint receiver(const Scene& scene, const Vec3& p, const Vec3& n);

}  // namespace phos::inline scene
