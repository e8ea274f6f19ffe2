// Estimators that sample hemispheres, and their last hemispheres.
#pragma once

#include <span>
#include <vector>

#include "estimate/estimator.h"

namespace phos::inline estimate {

struct Hemisphere;
struct SeenPass;

class HemisphereEstimator : public Estimator {
 public:
  /// What the worker's last make() saw; valid until its next.
  virtual std::vector<SeenPass> last_seen(const Worker& worker) const = 0;
  /// What make() makes of these hemispheres at a site, however they were had.
  virtual Made record_from(const RecordSite& site, std::span<const Hemisphere> passes,
                           Worker& worker) const = 0;
};

}  // namespace phos::inline estimate
