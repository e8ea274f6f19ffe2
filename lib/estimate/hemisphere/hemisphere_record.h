// What estimators that look over a hemisphere have in common: light where they look, and the record of it.
#pragma once

#include <memory>
#include <vector>

#include "estimate/hit_light.h"
#include "estimate/record_of.h"

namespace phos::inline estimate {

/// Few rays that meet gloss under a coat, which is signed, can add up to less than nothing: that is dark.
inline constexpr const char* kBelowZeroEvent = "gathered irradiance below zero";

/// docs/methods.md#e6: a footprint's axis that is as short as --min-radius allows, and along which light is
/// still no parabola.
inline constexpr const char* kUnresolvedEvent = "axes of footprints left unresolved";

/// Memory and counts of one thread.
struct HemisphereWorker : Estimator::Worker {
  std::unique_ptr<HitLight::Worker> light;
  std::vector<LampSample> lamps, lamps_nearby;
};

/// Const, usable from any thread; holds references.
struct HemisphereRecords {
  const RayScene& rays;
  const Luminaires& lights;
  RecordOptions options;
  std::uint64_t seed;
  GatherSource source;
  HitLight light;

  HemisphereRecords(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
                    const RecordOptions& resolved, std::uint64_t seed);

  /// The record of what hemispheres at a site have shown; with paths = all, direct light is added from
  /// samples of the lamps. No component is below 0 (kBelowZeroEvent). Passes the counts of `worker.light` on
  /// to the worker. `passes` are what `around` was made of: a footprint follows from them where records are
  /// to have one; those of its axes that are off by more than rho at their least length are counted
  /// (kUnresolvedEvent).
  Made record(const RecordSite& site, PlaceLight around, std::span<const Hemisphere> passes,
              HemisphereWorker& worker) const;

 private:
  Vec3 within_sight(const RecordSite& site, float lift_m, const Vec3& step) const;
  void fit(const RecordSite& site, float site_least_m, std::span<const Hemisphere> passes,
           HemisphereWorker& worker, IrradianceRecord& record) const;
};

/// A site with a normal of its own (a smooth one) looks into its own surface: nothing comes from there.
/// Clears what lies no higher than twice `lift_m`, the rounding of the site, and faces about the same way.
void clear_own_surface(float lift_m, Hemisphere& h);

}  // namespace phos::inline estimate
