// Places that go with the surface they lie on, however it moves.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "scene/rays.h"
#include "scene/scene.h"

namespace phos::inline scene {

inline constexpr std::uint32_t kNoTriangle = ~0u;

/// A point of a triangle, by barycentric weights of its second and third vertex (as Hit has them).
struct Anchor {
  std::uint32_t triangle = kNoTriangle;
  float u = 0, v = 0;
};

/// Where a triangle has taken one of its points, and how it is turned.
struct Pose {
  Vec3 position{0};            ///< m
  glm::quat turn{1, 0, 0, 0};  ///< unit; takes the axes x, y, z to edge 0-1, to what completes the frame, and
                               ///< to the normal by winding
};
/// Nothing where the triangle has no area at that time: the place is not there. Throws nothing: an anchor
/// beyond the scene's triangles gives nothing.
std::optional<Pose> pose_of(const Scene& scene, const Anchor& anchor);

/// The surface at p that faces n (unit, from the side it is seen): the nearest within some roundings of
/// positions to either side. Its triangle is kNoTriangle where there is none.
Anchor anchor_at(const RayScene& rays, const Vec3& p, const Vec3& n);

/// A vector (direction, gradient) that turned with the surface between two poses.
inline Vec3 turned(const Pose& from, const Pose& to, const Vec3& v) {
  return to.turn * (glm::conjugate(from.turn) * v);
}

}  // namespace phos::inline scene
