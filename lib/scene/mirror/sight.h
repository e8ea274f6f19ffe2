// Which sides of flat mirrors the light of lamps gets to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vector.h"
#include "scene/rays.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// Looks at lamps from a fixed set of places on mirrors, and from mirror to mirror, through nothing but
/// panes. Where it finds nothing there may still be a little light. Backs of mirrors that hang at a wall and
/// insides of closed bodies are such sides. Holds a reference.
class MirrorSight {
 public:
  /// A side of the plane of a mirror.
  struct Side {
    std::size_t plane = 0;
    bool front = true;  ///< to which the plane's normal points
  };

  /// `normals` of the planes; `plane_of` each triangle, negative: of none.
  MirrorSight(const Scene& scene, std::span<const Vec3> normals, std::span<const std::int32_t> plane_of);

  /// Share of all pairs of a place on that side and a lamp that has images (scene/mirror/images.h) that see
  /// each other, by 256 of them.
  float lit_share(const Side& side) const;
  /// Share of all pairs of places on both sides that see each other, by 256 of them.
  float seen_share(const Side& a, const Side& b) const;

 private:
  struct Place {
    Vec3 position{0};
    float error_m = 0;  // bound on its rounding error
  };
  static std::vector<Place> places_on(const Scene& scene, std::span<const std::uint32_t> triangles);
  void find_lamps();
  Vec3 normal(const Side& side) const { return side.front ? normal_[side.plane] : -normal_[side.plane]; }
  bool free_between(const Place& from, const Vec3& normal, const Place& to) const;

  const Scene& scene_;
  RayScene rays_;
  std::vector<Vec3> normal_;
  std::vector<std::vector<Place>> place_;  // per plane
  std::vector<Place> lamp_;                // a place on each of some lamps
  std::vector<Vec3> far_lamp_;             // unit, to them
};

}  // namespace phos::inline scene
