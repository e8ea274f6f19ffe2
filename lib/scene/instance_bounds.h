// The box about an instance.
#pragma once

#include "scene/scene.h"

namespace phos::inline scene {

/// About the corners of its triangles, in the world; empty where it has none.
Bounds bounds_of(const Scene& scene, const Instance& instance);

}  // namespace phos::inline scene
