// Radiance records by rays over the hemisphere.
#pragma once

#include <cstdint>
#include <memory>

#include "estimate/gather_source.h"
#include "estimate/hemisphere/hemisphere_estimator.h"
#include "estimate/radiance_record.h"

namespace phos::inline scene {
class Luminaires;
class RayScene;
}  // namespace phos::inline scene

namespace phos::inline estimate {

struct SeenPass;

/// One stratified hemisphere of rays per record, uniform over solid angle, each lit where it lands as
/// GatherEstimator does. Const, usable from any thread, each with a worker of its own; holds references.
class RadianceEstimator : public HemisphereEstimator {
 public:
  /// Of `resolved` it takes rays, gather_bounces, radius and its bounds; all rays are spent. Random
  /// numbers differ from the numbers of irradiance records with the same seed. Throws Error(usage) for an
  /// order outside 1 .. HshRotator::kMaxOrder.
  RadianceEstimator(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
                    const RecordOptions& resolved, int order, RadianceGradient gradient, std::uint64_t seed);
  ~RadianceEstimator() override;
  std::unique_ptr<Estimator::Worker> make_worker() const override;

  /// The record at a site is Made::radiance. Its radius is limited by its surroundings (reach_m) and the
  /// surface next to it.
  Made make(const RecordSite& site, Estimator::Worker& worker) const override;
  std::vector<SeenPass> last_seen(const Estimator::Worker& worker) const override;
  /// Of one pass.
  Made record_from(const RecordSite& site, std::span<const Hemisphere> passes,
                   Estimator::Worker& worker) const override;
  /// The hemisphere of the last make().
  static const Hemisphere& seen(const Estimator::Worker& worker);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline estimate
