// The two sides of every triangle, and which places on them light can reach.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/rays.h"

namespace phos::inline place {

/// One side of one triangle: 2 * triangle, + 1 for its back.
using Side = std::uint32_t;

class SurfaceSides {
 public:
  /// Holds a reference to rays.
  explicit SurfaceSides(const RayScene& rays);

  /// Sides that records light: of triangles that have an area and are not purely specular.
  const std::vector<Side>& sides() const { return sides_; }
  double area_m2(Side side) const { return area_m2_[side / 2]; }
  /// Point of a side at barycentric weights uv of the second and third vertex.
  SurfacePoint point(Side side, const Vec2& uv) const;
  /// Inside of a solid: all rays from there end at backs of opaque surfaces. Also where the surface has a
  /// hole (alpha mask). Never inside of a solid if the scene's cameras are, as in a room turned inside out.
  bool closed_off(const SurfacePoint& point) const;

 private:
  bool shut_in(const SurfacePoint& point, bool look_again) const;
  bool cameras_see_backs() const;
  const RayScene& rays_;
  std::vector<Side> sides_;
  std::vector<double> area_m2_;  // per triangle
  std::vector<Vec3> normal_;     // per triangle, of its front
  bool oriented_;                // fronts look away from solids
};

}  // namespace phos::inline place
