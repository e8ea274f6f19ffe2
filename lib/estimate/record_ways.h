// The ways of light that records of some options do not hold.
#pragma once

#include <vector>

#include "estimate/record_options.h"
#include "scene/report/unsampled.h"

namespace phos::inline estimate {

/// How records are estimated, and from how many samples each.
Sampler sampler_of(const RecordOptions& records);
double samples_of(const RecordOptions& records);

/// Looks at the scene, warns (Tool::doubt) of what such records will not hold, and returns it.
std::vector<LightWay> tell_missed_ways(Tool& tool, const RayScene& rays, const RecordOptions& records);

}  // namespace phos::inline estimate
