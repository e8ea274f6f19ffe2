// Where a lamp with an area lies.
#pragma once

#include "core/vector.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// A ball that holds the lamp, and the way it faces.
struct LampExtent {
  Vec3 centre{0};
  float radius_m = kInfinity;
  Vec3 front{0};  ///< normal of a plane lamp that shines from one side; else 0
};
/// Of a lamp of kind area.
LampExtent extent_of(const Scene& scene, const Light& light);

}  // namespace phos::inline scene
