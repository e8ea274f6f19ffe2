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

std::vector<LightWay> tell_missed_ways(Tool& tool, const RayScene& rays, const RecordOptions& records) {
  const Sampler sampler = sampler_of(records);
  if (sampler == Sampler::photons) return {};
  const double samples = samples_of(records);
  const std::vector<LightWay> missed =
      unsampled(light_ways(rays, Luminaires(rays.scene())), sampler, samples);
  tell_unsampled(tool, missed, sampler, samples);
  return missed;
}

}  // namespace phos::inline estimate
