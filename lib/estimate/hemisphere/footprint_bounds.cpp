#include "estimate/hemisphere/footprint_bounds.h"

#include <algorithm>

#include "direct/direct_light.h"
#include "estimate/next_surface.h"

namespace phos::inline estimate {

FootprintBounds footprint_bounds(const RayScene& rays, const RecordSite& site, float site_least_m,
                                 const RecordOptions& resolved, double read_with) {
  const float rounding_m = receiver(rays.scene(), site.position, site.normal).error_m;
  const auto least_m = static_cast<float>(*resolved.min_radius_m),
             most_m = static_cast<float>(*resolved.max_radius_m);
  FootprintBounds bounds;
  bounds.accuracy = static_cast<float>(read_with);
  bounds.rho = static_cast<float>(resolved.rho);
  bounds.least_m = std::clamp(site_least_m, least_m, most_m);
  bounds.most_m = std::clamp(site.most_radius_m, bounds.least_m, most_m);
  const float next_m = height_over_next_m(rays, site.position, site.normal, 2 * rounding_m, bounds.most_m);
  bounds.most_m = std::max(bounds.least_m, std::min(bounds.most_m, next_m / kNextSurface));
  return bounds;
}

}  // namespace phos::inline estimate
