#include "estimate/record_ways.h"

namespace phos::inline estimate {

Sampler sampler_of(const RecordOptions& records) {
  const bool photons = of_photons_alone(records);
  if (photons) return Sampler::photons;
  return records.caustics_apart ? Sampler::gathering_beside_caustics : Sampler::gathering;
}

double samples_of(const RecordOptions& records) {
  const auto side = static_cast<double>(records.raster_side);
  return records.estimate == Estimate::raster ? side * side : static_cast<double>(records.rays);
}

std::vector<LightWay> missed_ways(const RayScene& rays, const RecordOptions& records) {
  const Sampler sampler = sampler_of(records);
  if (sampler == Sampler::photons) return {};
  return unsampled(light_ways(rays, Luminaires(rays.scene())), sampler, samples_of(records));
}

std::vector<LightWay> tell_missed_ways(Tool& tool, const RayScene& rays, const RecordOptions& records) {
  const std::vector<LightWay> missed = missed_ways(rays, records);
  tell_unsampled(tool, missed, sampler_of(records), samples_of(records));
  return missed;
}

}  // namespace phos::inline estimate
