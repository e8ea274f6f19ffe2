#include "scene/instance_bounds.h"

namespace phos::inline scene {

Bounds bounds_of(const Scene& scene, const Instance& instance) {
  Bounds bounds;
  for (std::uint32_t t = 0; t < instance.triangle_count; ++t)
    for (const std::uint32_t v : scene.triangle[instance.first_triangle + t].v)
      bounds.include(scene.position[v]);
  return bounds;
}

}  // namespace phos::inline scene
