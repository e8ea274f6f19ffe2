#include "estimate/hemisphere/hemisphere_radiance.h"

#include <algorithm>

#include "direct/direct_light.h"
#include "estimate/next_surface.h"

namespace phos::inline estimate {

Made HemisphereRadiance::record(const RecordSite& site, const Hemisphere& h,
                                std::span<const RayBorder> borders, RadianceProjector& projector) const {
  // The radius asks for gradients even where the record is to have none.
  const bool without = gradient == RadianceGradient::none;
  const RadianceGradient mode = without ? RadianceGradient::hybrid : gradient;
  RadianceRecord record = projector.project(h, mode, static_cast<float>(*options.min_radius_m), borders);
  record.position = site.position;
  require_finite(rays.scene().origin_m, record);
  const float reach = reach_m(record, h, options);
  if (without) record.gradient_x.clear(), record.gradient_y.clear();
  const float rounding_m = receiver(rays.scene(), site.position, site.normal).error_m;
  const float next_m = height_over_next_m(rays, site.position, site.normal, 2 * rounding_m, reach);
  record.radius_m = std::min(reach, next_m / kNextSurface);
  Made made{irradiance_of(record), 0, site.least_radius_m, site.most_radius_m};
  made.least_share = source.least_share(site);
  made.radiance = std::make_shared<RadianceRecord>(std::move(record));
  return made;
}

}  // namespace phos::inline estimate
