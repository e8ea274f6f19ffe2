// Estimators that sample hemispheres, and what they saw last.
#pragma once

#include <span>
#include <vector>

#include "cache/estimator.h"
#include "cache/hemisphere.h"
#include "scene/rays.h"

namespace phos {

/// One pass over a hemisphere, and what each of its rays hit.
struct SeenPass {
  const Hemisphere* hemisphere;
  std::span<const Hit> hits;
};

class HemisphereEstimator : public Estimator {
 public:
  /// What the worker's last make() saw; valid until its next.
  virtual std::vector<SeenPass> last_seen(const Worker& worker) const = 0;
  /// What make() makes of these hemispheres at a site, however they were had.
  virtual Made record_from(const RecordSite& site, std::span<const Hemisphere> passes,
                           Worker& worker) const = 0;
};

}  // namespace phos
