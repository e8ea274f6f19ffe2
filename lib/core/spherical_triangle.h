// A triangle as it is seen from a point.
#pragma once

#include <optional>

#include "core/vector.h"

namespace phos {

/// Solid angle of a triangle, and directions uniform over it (Arvo 1995, "Stratified sampling of spherical
/// triangles").
class SphericalTriangle {
 public:
  SphericalTriangle(const Vec3 corner[3], const Vec3& from);

  /// sr, in [0, 2 pi]; by van Oosterom and Strackee (1983). 0 where the point lies in the triangle's plane
  /// outside of the triangle, in one of its corners, or where the triangle has no area.
  double solid_angle_sr() const { return solid_angle_sr_; }

  /// Weights of the second and third corner at the place of the triangle that is seen in the direction of
  /// `u`, both at least 0, their sum at most 1. The solid angle must not be 0.
  Vec2 sample(const Vec2& u) const;

 private:
  DVec3 a_, b_;           // directions of the first two corners
  DVec3 from_a_to_c_{0};  // tangent of that arc at a
  DVec3 side_[3];         // normals of the planes through the point and the edge opposite a corner, m2
  double cos_ab_ = 1, cos_alpha_ = 1, sin_alpha_ = 0, solid_angle_sr_ = 0;
};

/// A triangle, or a parallelogram as two that turn about a corner, so that even points of the square are even
/// points of the parallelogram.
class SphericalPatch {
 public:
  SphericalPatch(const Vec3 corner[3], const Vec3& from);
  /// The parallelogram of three corners and that opposite to the first.
  SphericalPatch(const Vec3 corner[3], const Vec3& opposite, const Vec3& from);

  double solid_angle_sr() const { return solid_angle_sr_; }

  struct Place {
    bool second = false;  ///< in the triangle of the last corner, the second one and the opposite one
    Vec2 weights{0};      ///< of that triangle's second and third corner
  };
  /// Uniform over the solid angle, which must not be 0.
  Place sample(const Vec2& u) const;

 private:
  SphericalTriangle first_;
  std::optional<SphericalTriangle> second_;
  double solid_angle_sr_ = 0;
};

}  // namespace phos
