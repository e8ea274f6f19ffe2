#include "cache/hemisphere_record.h"

#include <algorithm>

#include "cache/next_surface.h"
#include "core/error.h"
#include "core/random.h"

namespace phos {
namespace {

/// A surface of this cosine or more with the site's normal, as near as its rounding, is the site's own.
constexpr float kOwnSurface = 0.5f;

}  // namespace

HemisphereRecords::HemisphereRecords(const RayScene& r, const Luminaires& l, const GatherSource& source,
                                     const RecordOptions& resolved, std::uint64_t own_seed)
    : rays(r), lights(l), options(resolved), seed(own_seed), light(r, l, source, resolved, own_seed) {
  PHOS_CHECK(resolved.min_radius_m && resolved.max_radius_m, "resolve() first");
}

Made HemisphereRecords::record(const RecordSite& site, PlaceLight around, HemisphereWorker& worker) const {
  const SurfacePoint place = receiver(rays.scene(), site.position, site.normal);
  if (options.paths == Quantity::all) {
    RandomStream random(seed, Stage::direct_light, site.item);
    const int samples = static_cast<int>(options.light_samples);
    sample_lamps(rays, lights, place, samples, random, worker.lamps);
    add_lamps(worker.lamps, samples, lights, site.normal, options, around);
  }
  Made made = record_of(site, around, options, rays.scene().origin_m);
  // Under a coat the gloss of a hit is signed, and of few rays the sum may be too.
  if (glm::any(glm::lessThan(made.record.irradiance, Rgb(0)))) {
    made.record.irradiance = glm::max(made.record.irradiance, Rgb(0));
    worker.counters.count(kBelowZeroEvent);
  }
  float& radius_m = made.record.radius_m;
  const float next_m = height_over_next_m(rays, site.position, site.normal, 2 * place.error_m, radius_m);
  radius_m = std::min(radius_m, next_m / kNextSurface);
  worker.counters.merge(worker.light->counters);
  worker.light->counters = Counters();
  return made;
}

void clear_own_surface(float lift_m, Hemisphere& h) {
  for (std::size_t i = 0; i < h.size(); ++i) {
    const float height_m = -glm::dot(h.direction[i], h.hit_normal[i]) * h.distance_m[i];
    if (height_m > 2 * lift_m || glm::dot(h.hit_normal[i], h.frame.z) < kOwnSurface) continue;
    h.radiance[i] = Rgb(0), h.distance_m[i] = kInfinity, h.hit_normal[i] = -h.direction[i];
  }
}

}  // namespace phos
