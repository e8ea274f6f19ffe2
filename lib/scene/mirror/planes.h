// Flat mirrors of a scene, and the chains of them that light is followed over exactly.
#pragma once

#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// Surfaces that lie in one plane and reflect as mirrors do: mirrors, polished metal, panes, glossy coats
/// without roughness. Light of a lamp over a chain of them comes as if from an image of the lamp, so that
/// shadow rays find it (MirrorImages). Only the largest and brightest planes are taken, and the brightest
/// chains that light gets to (MirrorSight); light over others is left to photons.
class MirrorPlanes {
 public:
  static constexpr std::int32_t kNone = -1;

  explicit MirrorPlanes(const Scene& scene);

  bool empty() const { return chain_.empty(); }

  struct Plane {
    Vec3 point{0}, normal{0, 0, 1};  ///< unit
    Bounds box;                      ///< of the surfaces in the plane
    float slack_m = 0;               ///< so far rounding may put a point off the plane or out of the box
    float reflectance = 0;           ///< luminance, at normal incidence: the greatest of its materials
    float area_m2 = 0;

    bool front_of(const Vec3& p) const { return glm::dot(p - point, normal) > 0; }
    Vec3 mirrored(const Vec3& p) const { return p - 2 * glm::dot(p - point, normal) * normal; }
    Vec3 mirrored_direction(const Vec3& d) const { return d - 2 * glm::dot(d, normal) * normal; }
  };
  const Plane& plane(std::int32_t i) const { return plane_[static_cast<std::size_t>(i)]; }
  /// The plane that a triangle lies in; kNone: of no mirror that is taken.
  std::int32_t plane_of(std::uint32_t triangle) const {
    return plane_of_.empty() ? kNone : plane_of_[triangle];
  }

  /// A chain from the lamp on: the one before it, and one more reflection, on one side of a plane.
  struct Chain {
    std::int32_t before = kNone;  ///< kNone: light straight from the lamp
    std::int32_t plane = 0;
    bool front = true;
    float reflectance = 1;  ///< product along the chain
    std::vector<std::int32_t> next;
  };
  const std::vector<Chain>& chains() const { return chain_; }
  /// The chain that a reflection off a triangle's given side makes of `chain` (kNone: straight from the
  /// lamp); kNone where that one is not taken.
  std::int32_t follow(std::int32_t chain, std::uint32_t triangle, bool front_of_triangle) const;
  /// Image of a receiver as the lamp sees it over a chain.
  Vec3 image(std::int32_t chain, const Vec3& receiver) const;
  /// Image of a place on a lamp, or of the direction to a far one, as a receiver sees it over a chain.
  Vec3 image_of_lamp(std::int32_t chain, const Vec3& lamp) const;
  Vec3 image_of_direction(std::int32_t chain, const Vec3& towards) const;

 private:
  void find_planes(const Scene& scene);
  void find_chains(const Scene& scene);
  /// Has one plane's box a part on that side of the other?
  bool beside(const Plane& part, const Plane& of, bool front) const;

  std::vector<Plane> plane_;
  std::vector<std::int32_t> plane_of_;
  std::vector<std::uint8_t> turned_;  // the triangle faces the other way than its plane
  std::vector<Chain> chain_;
  std::vector<std::int32_t> first_;  // chains of one reflection
};

}  // namespace phos::inline scene
