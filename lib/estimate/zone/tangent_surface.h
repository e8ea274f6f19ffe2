// The surface about a place, as it lies along its tangent plane.
#pragma once

#include "core/vector.h"
#include "scene/rays.h"

namespace phos::inline estimate {

/// The tangent plane at a place, and the slab about it that holds the photons of its zone.
struct ZonePlace {
  Vec3 p;
  Frame frame;
  float rounding_m;                // of coordinates here
  float above_m = 0, below_m = 0;  // of the slab
  bool parted = false;             // something stands between the place and a part of its surface
};

/// Half thickness of a zone in its radii (docs/methods.md#c5).
inline constexpr float kSlab = 0.05f;
/// Half thickness of a zone of this radius, m.
float slab_m(const ZonePlace& place, float radius_m);
/// Cosine between normals from which two places count as one surface.
inline constexpr float kSameFacing = 0.9396926f;  // cos 20 deg (docs/methods.md#c5)
/// Looks for it by short rays. Const and usable from any thread; holds a reference.
class TangentSurface {
 public:
  explicit TangentSurface(const RayScene& rays) : rays_(rays) {}

  /// Parallel sheets: the slab ends half way to the next surface above and below, if one is within it.
  void limit_slab(ZonePlace& place, float radius_m) const;

  /// Is there surface of this facing at an offset on the tangent plane, in sight of the place? Sets
  /// place.parted where there is, but out of sight.
  bool on_surface(ZonePlace& place, const Vec2& offset_m) const;

  /// Does a line above the surface lead from the place to a point `height_m` over its plane at an offset?
  /// Walls that stand on the surface part it, and surfaces run on inside of walls, where no light comes.
  bool within_sight(const ZonePlace& place, const Vec2& offset_m, float height_m) const;

 protected:
  const RayScene& rays_;
};

}  // namespace phos::inline estimate
