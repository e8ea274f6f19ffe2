#include "estimate/hemisphere/hemisphere_record.h"

#include <algorithm>

#include "core/error.h"
#include "core/random.h"
#include "estimate/events.h"
#include "estimate/hemisphere/footprint_bounds.h"
#include "estimate/next_surface.h"

namespace phos::inline estimate {
namespace {

/// A surface of this cosine or more with the site's normal, as near as its rounding, is the site's own.
constexpr float kOwnSurface = 0.5f;

/// What light does nearby is told by about so many shadow rays to all lamps of an extent together, and no
/// fewer than that to each.
constexpr std::int64_t kRaysNearby = 64, kLeastRaysNearby = 4;

int samples_nearby(const Luminaires& lights, std::int64_t most) {
  std::int64_t extended = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) extended += lights[i].extended();
  const std::int64_t each = std::max(kRaysNearby / std::max<std::int64_t>(extended, 1), kLeastRaysNearby);
  return static_cast<int>(std::min(most, each));
}

}  // namespace

HemisphereRecords::HemisphereRecords(const RayScene& r, const Luminaires& l, const GatherSource& s,
                                     const RecordOptions& resolved, std::uint64_t own_seed)
    : rays(r), lights(l), options(resolved), seed(own_seed), source(s), light(r, l, s, resolved, own_seed) {
  PHOS_CHECK(resolved.min_radius_m && resolved.max_radius_m, "resolve() first");
}

Made HemisphereRecords::record(const RecordSite& site, PlaceLight around, std::span<const Hemisphere> passes,
                               HemisphereWorker& worker) const {
  const SurfacePoint place = receiver(rays.scene(), site.position, site.normal);
  const float share = source.least_share(site);
  worker.lamps.clear();
  if (options.paths == Quantity::all) {
    RandomStream random(seed, Stage::direct_light, site.item);
    const int samples = static_cast<int>(options.light_samples);
    sample_lamps(rays, lights, place, samples, random, worker.lamps);
    add_lamps(worker.lamps, samples, lights, site.normal, options, around);
  }
  Made made = record_of(site, around, options, rays.scene().origin_m);
  made.least_share = share;
  // Under a coat the gloss of a hit is signed, and of few rays the sum may be too.
  if (glm::any(glm::lessThan(made.record.irradiance, Rgb(0)))) {
    made.record.irradiance = glm::max(made.record.irradiance, Rgb(0));
    worker.counters.count(kBelowZeroEvent);
  }
  float& radius_m = made.record.radius_m;
  const float next_m = height_over_next_m(rays, site.position, site.normal, 2 * place.error_m, radius_m);
  radius_m = std::min(radius_m, next_m / kNextSurface);
  if (options.footprint == Footprint::adaptive)
    fit(site, share * site.least_radius_m, passes, worker, made.record);
  worker.counters.merge(worker.light->counters);
  worker.light->counters = Counters();
  return made;
}

/// A step on the tangent plane, no farther than to an object that stands on the surface: beyond it other
/// light shines.
Vec3 HemisphereRecords::within_sight(const RecordSite& site, float lift_m, const Vec3& step) const {
  const float length = glm::length(step);
  Hit hit;
  if (!(length > 0) ||
      !rays.intersect({site.position + 2 * lift_m * site.normal, step / length, 0, length}, hit))
    return step;
  return std::max(hit.distance_m - 4 * lift_m, 0.f) / length * step;
}

void HemisphereRecords::fit(const RecordSite& site, float site_least_m, std::span<const Hemisphere> passes,
                            HemisphereWorker& worker, IrradianceRecord& record) const {
  const float lift_m = receiver(rays.scene(), site.position, site.normal).error_m;
  const FootprintBounds bounds =
      footprint_bounds(rays, site, site_least_m, options, reading_accuracy(options.accuracy));
  const LightNearby nearby(passes, options.gradients, static_cast<float>(*options.min_radius_m));
  std::function<Rgb(const Vec2&)> direct;
  if (options.paths == Quantity::all && lights.size() > 0) {
    const int samples = samples_nearby(lights, options.light_samples);
    direct = [&, samples](const Vec2& step) {
      const Vec3 p = site.position + within_sight(site, lift_m, nearby.frame().to_world(Vec3(step, 0)));
      RandomStream random(seed, Stage::direct_light, site.item);  // the same places on the lamps
      sample_lamps(rays, lights, receiver(rays.scene(), p, site.normal), samples, random,
                   worker.lamps_nearby);
      return Rgb(light_of(worker.lamps_nearby));
    };
  }
  const FittedFootprint fitted =
      fit_footprint(passes, nearby, direct, worker.lamps, record.rotation_gradient, bounds);
  if (what_is_wrong(*fitted.footprint, site.normal)) throw_beyond_range(rays.scene().origin_m, site.position);
  record.footprint = fitted.footprint;
  record.radius_m = fitted.radius_m;
  if (fitted.unresolved > 0)
    worker.counters.count(kUnresolvedEvent, static_cast<std::uint64_t>(fitted.unresolved));
}

void clear_own_surface(float lift_m, Hemisphere& h) {
  for (std::size_t i = 0; i < h.size(); ++i) {
    const float height_m = -glm::dot(h.direction[i], h.hit_normal[i]) * h.distance_m[i];
    if (height_m > 2 * lift_m || glm::dot(h.hit_normal[i], h.frame.z) < kOwnSurface) continue;
    h.radiance[i] = Rgb(0), h.distance_m[i] = kInfinity, h.hit_normal[i] = -h.direction[i];
  }
}

}  // namespace phos::inline estimate
