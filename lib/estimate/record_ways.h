// The ways of light that records of some options do not hold.
#pragma once

#include <vector>

#include "estimate/record_options.h"
#include "scene/report/unsampled.h"

namespace phos::inline estimate {

/// How records are estimated, and from how many samples each.
Sampler sampler_of(const RecordOptions& records);
double samples_of(const RecordOptions& records);

/// The ways that the lamps of a scene take and such records do not hold. No ray is sent for records of
/// photons, which hold all.
std::vector<LightWay> missed_ways(const RayScene& rays, const RecordOptions& records);

/// Looks at the scene, warns (Tool::doubt) of light that such records will not hold, and returns its ways.
std::vector<LightWay> tell_missed_ways(Tool& tool, const RayScene& rays, const RecordOptions& records);

}  // namespace phos::inline estimate
