// What a place leaves to the axes of a footprint.
#pragma once

#include "estimate/estimator.h"
#include "estimate/hemisphere/footprint_fit.h"
#include "estimate/record_options.h"

namespace phos::inline scene {
class RayScene;
}

namespace phos::inline estimate {

/// The bounds that `resolved`, the site (at least `site_least_m`) and the surface next to it set for axes of
/// a record that is read at accuracy `read_with`.
FootprintBounds footprint_bounds(const RayScene& rays, const RecordSite& site, float site_least_m,
                                 const RecordOptions& resolved, double read_with);

}  // namespace phos::inline estimate
