// Samples of the images that lamps have in flat mirrors, for places that gathered rays find.
#pragma once

#include <vector>

#include "core/random.h"
#include "scene/luminaires.h"
#include "scene/rays.h"

namespace phos {

/// Chooses one of the images that lamps have in flat mirrors (scene/mirror_images.h), a chain of mirrors by
/// its reflectance and a lamp by its power. Every image has a chance. Const, usable from any thread; holds
/// references.
class ImageSampler {
 public:
  ImageSampler(const RayScene& rays, const Luminaires& lights);

  /// There are no images.
  bool empty() const { return chain_.empty() || lamp_.empty(); }

  struct Sample {
    Rgb lux{0};         ///< on the point's surface; cosine, density and the choice included; 0: none arrives
    Vec3 direction{0};  ///< unit, to where it comes from
    bool extended = false;  ///< rays could find the lamp too
  };
  /// One sample, unbiased. Images of more than `most_reflections` (negative: no limit) count as dark. Draws
  /// from `random`. There must be an image.
  Sample sample(const SurfacePoint& point, std::int64_t most_reflections, RandomStream& random) const;

 private:
  struct Choice {
    std::size_t index = 0;
    double below = 0, up_to = 0;  // probability of those before it, and with it
    std::int64_t reflections = 0;
  };
  static const Choice& choose(const std::vector<Choice>& among, double u);

  const RayScene& rays_;
  const Luminaires& lights_;
  std::vector<Choice> chain_, lamp_;
};

}  // namespace phos
