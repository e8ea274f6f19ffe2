// An opening through which a room gets light from infinitely far away.
#pragma once

#include "core/vector.h"

namespace phos::inline scene {

/// A plane piece of an opening: a parallelogram, or half of one.
struct Portal {
  Vec3 corner{0}, edge[2]{Vec3(0), Vec3(0)};
  bool triangle = false;
  Vec3 inwards{0};  ///< unit normal: light counts that goes that way; 0: both ways

  /// The place of these weights of the edges, from 0 to 1 (of a triangle, their sum too).
  double area_m2() const {
    return (triangle ? 0.5 : 1.0) * glm::length(glm::cross(DVec3(edge[0]), DVec3(edge[1])));
  }
  Vec3 at(const Vec2& weight) const { return corner + weight.x * edge[0] + weight.y * edge[1]; }
};

/// Does the whole line through a point in a direction (unit) cross the piece? Lines within its plane do not.
bool crosses(const Portal& portal, const DVec3& point, const DVec3& direction);

}  // namespace phos::inline scene
