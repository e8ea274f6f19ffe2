#include "scene/node_extent.h"

#include <algorithm>

#include "core/error.h"

namespace phos::inline scene {

void NodeExtent::include(const std::vector<Vec3>& local, const glm::dmat4& to_world,
                         const std::string& what) {
  Bounds box;
  for (const Vec3& p : local) {
    if (is_finite(p)) box.include(p);
  }
  if (box.empty()) return;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const DVec3 p(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                  corner & 4 ? box.hi.z : box.lo.z);
    world_.include(DVec3(to_world * glm::dvec4(p, 1)));
  }
  const double far = std::max(max_component(glm::abs(box.lo)), max_component(glm::abs(box.hi)));
  const double scale = std::max(
      {glm::length(DVec3(to_world[0])), glm::length(DVec3(to_world[1])), glm::length(DVec3(to_world[2]))});
  const double rounding_m = 0x1p-24 * far * scale;
  if (rounding_m > rounding_m_) rounding_m_ = rounding_m, farthest_m_ = far * scale, what_ = what;
}

std::string NodeExtent::coarse() const {
  if (!(rounding_m_ > 1e-5 * world_.diagonal_m()) || !(world_.diagonal_m() > 0)) return {};
  return text(what_, " has vertices ", shortest(static_cast<float>(farthest_m_)),
              " m off its own origin, which floats round to ", shortest(static_cast<float>(rounding_m_)),
              " m; put that offset into the node's translation");
}

}  // namespace phos::inline scene
