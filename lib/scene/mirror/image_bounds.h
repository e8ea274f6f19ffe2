// Which images of lamps in flat mirrors a place may see.
#pragma once

#include <optional>
#include <vector>

#include "scene/mirror/planes.h"
#include "scene/rays.h"

namespace phos::inline scene {

/// Compares balls about lamps with balls about mirrors, so that no image has to be looked for where it cannot
/// be. Const, usable from any thread.
class ImageBounds {
 public:
  ImageBounds(const Scene& scene, const MirrorPlanes& mirrors);

  /// A mirror as a place sees it: the ball about it.
  struct Sight {
    Vec3 way{0};  ///< m, to its middle
    float distance_m = 0, radius_m = 0;
    float sine = 1;  ///< of half the angle across; 1 from within
  };
  /// The mirror that the last reflection of a chain is off; nothing where none of its light can arrive.
  static std::optional<Sight> sight(const MirrorPlanes::Plane& mirror, bool front, const SurfacePoint& point);

  /// Illuminance at a point by the image of a light in a chain of mirrors, lx: a rough value without shadows
  /// and cosines. 0 only where no such light arrives. `last` is sight() of the chain's last mirror.
  float promise_lx(const MirrorPlanes& mirrors, std::size_t chain, std::size_t light, const Sight& last,
                   const SurfacePoint& point) const;
  float promise_lx(const MirrorPlanes& mirrors, std::size_t chain, std::size_t light,
                   const SurfacePoint& point) const;

 private:
  struct Lamp {
    bool has_images = true;
    bool far = false;  // directional, and the sun
    Vec3 centre{0};    // m; far: the unit direction there
    float radius_m = 0;
    float sine = 0;      // far: of half the angle across
    float strength = 0;  // cd, about its mean; far: lx
  };
  static Lamp lamp_of(const Scene& scene, const Light& light);
  Vec3 image_of(const MirrorPlanes& mirrors, std::size_t chain, std::size_t light) const;

  std::vector<Lamp> lamp_;   // per light; empty without mirrors
  std::vector<Vec3> image_;  // of the centres, chain by chain; empty where there are too many
};

}  // namespace phos::inline scene
