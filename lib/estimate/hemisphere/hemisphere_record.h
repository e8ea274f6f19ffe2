// The common part of estimators that look over a hemisphere: the light where they look, and the record.
#pragma once

#include <memory>
#include <vector>

#include "estimate/hit_light.h"
#include "estimate/record_of.h"

namespace phos::inline estimate {

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

  /// The record from hemispheres at a site; with paths = all, direct light is added from
  /// samples of the lamps. No component is below 0 (kBelowZeroEvent). Passes the counts of `worker.light` on
  /// to the worker. `passes` are the hemispheres from which `around` was made: a footprint follows from them
  /// where records are to have one; axes that are off by more than rho at their least length are counted
  /// (kUnresolvedEvent).
  Made record(const RecordSite& site, PlaceLight around, std::span<const Hemisphere> passes,
              HemisphereWorker& worker) const;

 private:
  Vec3 within_sight(const RecordSite& site, float lift_m, const Vec3& step) const;
  void fit(const RecordSite& site, float site_least_m, std::span<const Hemisphere> passes,
           HemisphereWorker& worker, IrradianceRecord& record) const;
};

/// A site with a normal of its own (a smooth one) looks into its own surface: nothing comes from there.
/// Clears hits that lie no higher than twice `lift_m`, the rounding of the site, and faces about the same
/// way.
void clear_own_surface(float lift_m, Hemisphere& h);

}  // namespace phos::inline estimate
