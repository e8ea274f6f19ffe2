#include "estimate/gather_source.h"

#include <algorithm>
#include <cmath>

#include "estimate/estimator.h"
#include "record/tree.h"

namespace phos::inline estimate {
namespace {

/// Times usual. From 1 on, the same error of Sibenik cost a tenth more records, and Cornell boxes, where much
/// is as bright, had more for nothing; from 4 on half of the gain was lost.
constexpr double kBright = 2;
/// Below it pictures gained next to nothing (Sibenik, staircase2), and records cost.
constexpr float kLeastShare = 0.25f;

}  // namespace

float GatherSource::least_share(const RecordSite& site) const {
  if (!indirect || !(usual_lx > 0)) return 1;
  float weight = 0;
  const auto lux = static_cast<double>(luminance(indirect->irradiance(site.position, site.normal, weight)));
  if (!(weight > 0) || !(lux > kBright * usual_lx)) return 1;
  return std::max(kLeastShare, static_cast<float>(std::sqrt(kBright * usual_lx / lux)));
}

}  // namespace phos::inline estimate
