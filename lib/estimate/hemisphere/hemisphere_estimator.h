// Estimators that sample hemispheres, and their last hemispheres.
#pragma once

#include <span>
#include <vector>

#include "direct/lamp_sampler.h"
#include "estimate/estimator.h"
#include "estimate/hemisphere/hemisphere.h"
#include "scene/rays.h"

namespace phos::inline estimate {

/// Light straight from a lamp at a diffuse hit, and the light that the hit then sends on.
struct LampSight {
  ArrivingLight light;
  Rgb brdf{0};            ///< 1/sr
  std::uint32_t hit = 0;  ///< which of the hits
  Rgb arrived{0};         ///< share that arrives, by channel: 0 where something is in the way
};

/// One pass over a hemisphere: the hit of each ray, and the lamps' light there.
struct SeenPass {
  const Hemisphere* hemisphere;
  std::span<const Hit> hits;
  std::span<const LampSight> sights;
};

class HemisphereEstimator : public Estimator {
 public:
  /// What the worker's last make() saw; valid until its next.
  virtual std::vector<SeenPass> last_seen(const Worker& worker) const = 0;
  /// What make() makes of these hemispheres at a site, however they were had.
  virtual Made record_from(const RecordSite& site, std::span<const Hemisphere> passes,
                           Worker& worker) const = 0;
};

}  // namespace phos::inline estimate
