#include "reference/measure_points.h"

#include "core/progress.h"
#include "reference/bidirectional_points.h"

namespace phos::inline reference {

MeasuredPoints measure_points(const RayScene& rays, const Luminaires& luminaires,
                              std::span<const SensorPoint> points, ReferenceMethod method,
                              const std::vector<LightWay>& ways, PointOptions options) {
  const bool both_ends = is_bidirectional(method, rays.scene(), ways, static_cast<double>(options.samples));
  MeasuredPoints measured{{}, {both_ends ? std::vector<LightWay>() : ways, Sampler::path_tracing}};
  if (both_ends) {
    measured.light = estimate_bidirectionally(rays, luminaires, points, options);
  } else {
    measured.doubts.prepare(options);
    Progress progress("reference", points.size(), "points");
    for (const SensorPoint& point : points) {
      measured.light.push_back(estimate_irradiance(rays, luminaires, point.position, point.normal, options));
      measured.doubts.judge(measured.light.back());
      ++options.item;
      progress.advance();
    }
  }
  for (const PointIrradiance& e : measured.light)
    measured.samples += e.samples, measured.rejected += e.rejected;
  return measured;
}

}  // namespace phos::inline reference
