// A portal as it is seen from places about it.
#pragma once

#include "core/spherical_triangle.h"
#include "scene/lamp/near.h"
#include "scene/opening/portal.h"

namespace phos::inline scene {

struct PortalPiece {
  Portal portal;
  Vec3 normal{0};  ///< unit, by winding
  Vec3 middle{0};
  float area_m2 = 0;
  float near2_m2 = 0;  ///< square of the distance from the middle within which it is near

  explicit PortalPiece(const Portal& portal);

  /// Distance from its plane, above 0 where it lets light through to that place.
  float before_m(const Vec3& from) const;
  /// The same of light that goes through it away from that place.
  float behind_m(const Vec3& from) const;
  /// A place of the piece, from two numbers in [0, 1): uniform over the solid angle where it is near, else
  /// over its area.
  Vec3 sample(const Vec3& from, const Vec2& u) const;
  /// Density per sr of the direction to that place; the line through `from` crosses the piece.
  double density(const Vec3& from, const Vec3& direction) const;

 private:
  /// As it is seen, where that is so wide that it is sampled by solid angle.
  bool is_near(const Vec3& from) const;
  SphericalPatch seen(const Vec3& from) const;
};

}  // namespace phos::inline scene
