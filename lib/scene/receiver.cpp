#include "scene/receiver.h"

#include <algorithm>

namespace phos::inline scene {

SurfacePoint receiver(const Scene& scene, const Vec3& p, const Vec3& n) {
  // The bound of scene/offset.h, for the largest coordinates and the longest edge that the scene can have.
  constexpr float kRoundoff = 0x1p-24f;
  float largest = max_component(glm::abs(p));
  if (!scene.bounds.empty())
    largest = std::max(
        {largest, max_component(glm::abs(scene.bounds.lo)), max_component(glm::abs(scene.bounds.hi))});
  SurfacePoint point;
  point.position = p;
  point.geometric_normal = point.smooth_normal = point.normal = n;
  point.tangent = make_frame(n).x;
  point.error_m = kRoundoff * (16 * largest + 32 * scene.bounds.diagonal_m());
  return point;
}

}  // namespace phos::inline scene
