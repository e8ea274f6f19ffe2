#include "estimate/hemisphere/hemisphere_radiance.h"

#include <algorithm>

#include "direct/direct_light.h"
#include "estimate/events.h"
#include "estimate/hemisphere/footprint_bounds.h"
#include "estimate/hemisphere/radiance_axes.h"
#include "estimate/next_surface.h"
#include "estimate/record_of.h"

namespace phos::inline estimate {

Made HemisphereRadiance::record(const RecordSite& site, const Hemisphere& h,
                                std::span<const RayBorder> borders, RadianceProjector& projector,
                                Counters& counters) const {
  // The radius asks for gradients even where the record is to have none.
  const bool without = gradient == RadianceGradient::none;
  const RadianceGradient mode = without ? RadianceGradient::hybrid : gradient;
  RadianceRecord record = projector.project(h, mode, static_cast<float>(*options.min_radius_m), borders);
  record.position = site.position;
  require_finite(rays.scene().origin_m, record);
  const float reach = reach_m(record, h, options);
  const float rounding_m = receiver(rays.scene(), site.position, site.normal).error_m;
  const float next_m = height_over_next_m(rays, site.position, site.normal, 2 * rounding_m, reach);
  record.radius_m = std::min(reach, next_m / kNextSurface);
  if (options.footprint == Footprint::adaptive) fit(site, h, record, counters);
  if (without) record.gradient_x.clear(), record.gradient_y.clear();
  Made made{irradiance_of(record), 0, site.least_radius_m, site.most_radius_m};
  made.least_share = source.least_share(site);
  made.radiance = std::make_shared<RadianceRecord>(std::move(record));
  return made;
}

void HemisphereRadiance::fit(const RecordSite& site, const Hemisphere& h, RadianceRecord& record,
                             Counters& counters) const {
  const float site_least_m = source.least_share(site) * site.least_radius_m;
  const FootprintBounds bounds =
      footprint_bounds(rays, site, site_least_m, options, radiance_reading_accuracy(options.accuracy));
  const FittedAxes fitted = fit_axes(h, record, gradient != RadianceGradient::none,
                                     static_cast<float>(*options.min_radius_m), bounds);
  record.footprint_m = fitted.length_m, record.radius_m = fitted.radius_m;
  if (!are_lengths(fitted.length_m)) throw_beyond_range(rays.scene().origin_m, site.position);
  if (fitted.unresolved > 0) counters.count(kUnresolvedEvent, static_cast<std::uint64_t>(fitted.unresolved));
}

}  // namespace phos::inline estimate
