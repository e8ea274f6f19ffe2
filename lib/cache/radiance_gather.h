// Radiance records by rays over the hemisphere.
#pragma once

#include <cstdint>
#include <memory>

#include "cache/gather.h"
#include "cache/radiance_record.h"

namespace phos {

/// One stratified hemisphere of rays per record, uniform over solid angle, each lit where it lands as
/// GatherEstimator does. Const, usable from any thread, each with a worker of its own; holds references.
class RadianceEstimator {
 public:
  /// Of `resolved` it takes rays, gather_bounces, radius and the bounds of it; all rays are spent. Random
  /// numbers are apart from those of irradiance records with the same seed. Throws Error(usage) for an order
  /// outside 1 .. HshRotator::kMaxOrder.
  RadianceEstimator(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
                    const RecordOptions& resolved, int order, RadianceGradient gradient, std::uint64_t seed);
  ~RadianceEstimator();
  std::unique_ptr<Estimator::Worker> make_worker() const;

  /// The record at a site. Its radius is limited by its surroundings, its gradient and the surface next to
  /// it, and then by the bounds (bounded_radius_m). Depends on the site and the seed alone; always finite.
  /// Throws Error(numerical) where a value exceeds the range of numbers.
  RadianceRecord make(const RecordSite& site, Estimator::Worker& worker) const;
  /// The hemisphere of the last make().
  static const Hemisphere& seen(const Estimator::Worker& worker);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos
