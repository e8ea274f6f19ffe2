// A cache that gets new records at points, one walk long.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "estimate/estimator.h"
#include "estimate/record_options.h"
#include "place/candidates.h"
#include "place/growth.h"
#include "place/parallel_maker.h"
#include "record/irradiance_cache.h"
#include "scene/rays.h"

namespace phos::inline view {

/// The new records are those that `phos-irradiance --add-to CACHE --place every --at FILE` makes with the
/// same seed, where FILE lists their places in order. Same records for any number of threads.
class GrownCache {
 public:
  /// `covering`: the records that are there, with the accuracy of the cache that grows; they stay as they
  /// are. A point within `beside_m` of a surface, along its normal, is taken to lie on it. Holds references
  /// to the estimator and the rays.
  GrownCache(const IrradianceCache& covering, const Estimator& estimator, const RayScene& rays,
             const RecordOptions& resolved, float beside_m);

  /// Adds a record at each point, one after another, unless a record covers the point at `share` (in (0, 1])
  /// of the cache's accuracy, or the point lies on no surface that shows the light of records
  /// (points_to_grow). Returns the number of new records. Throws Error(interrupted) between batches, with
  /// whole batches kept.
  std::size_t grow(std::span<const SurfaceSample> points, double share);

  /// All new records in the order in which they came, with radii as of now: later records may have reduced
  /// them.
  std::vector<IrradianceRecord> records();
  std::size_t size() const { return grown_; }  ///< of records()
  void count_into(Counters& counters);

 private:
  /// Of the new record after `number` more.
  RecordSite site_at(const SurfaceSample& point, std::size_t number) const;
  bool covered(const RecordSite& site, double share);

  const RayScene& rays_;
  float beside_m_;
  Growth growth_;
  ParallelMaker maker_;
  double accuracy_;
  std::size_t grown_ = 0, batch_;
  std::vector<const IrradianceRecord*> found_;
};

}  // namespace phos::inline view
