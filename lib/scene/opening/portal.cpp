#include "scene/opening/portal.h"

namespace phos::inline scene {

bool crosses(const Portal& portal, const DVec3& point, const DVec3& direction) {
  // Moller and Trumbore 1997, for the whole line.
  const DVec3 a(portal.edge[0]), b(portal.edge[1]), across = glm::cross(direction, b),
                                                    way = point - DVec3(portal.corner);
  const double determinant = glm::dot(a, across);
  const double u = glm::dot(way, across) / determinant;
  if (!(u >= 0 && u <= 1)) return false;
  const double v = glm::dot(direction, glm::cross(way, a)) / determinant;
  return v >= 0 && (portal.triangle ? u + v : v) <= 1;
}

}  // namespace phos::inline scene
