// The hashes of a scene and of its parts.
#pragma once

#include "scene/scene.h"

namespace phos::inline scene {

/// Fills hash and parts. Needs everything else.
void fill_hash(Scene& scene);

}  // namespace phos::inline scene
