// Irradiance records by rays over the hemisphere (final gathering).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "estimate/estimator.h"
#include "estimate/gather_source.h"
#include "estimate/hemisphere/hemisphere.h"
#include "estimate/hemisphere/hemisphere_estimator.h"

namespace phos::inline scene {
class Luminaires;
class RayScene;
}  // namespace phos::inline scene

namespace phos::inline estimate {

struct RecordOptions;
struct SeenPass;

/// Stratified cosine-weighted rays. With options.error, passes of growing number until the record's own
/// standard error is at most error x its value, or all options.rays are spent (counted). With paths = all,
/// direct light at the record is added from samples of the lamps. A record whose rays found no light at all
/// has as its standard error the light that one more lit ray would have brought, as far as lamps that were
/// hidden from the hits of the rays show it; 0 where none was. The stated error contains the error of the
/// rays (standard_error_of) and of the source (SourceNoise); records near each other share the error of the
/// source. options.error is asked of the rays alone. The stated error does not contain the smoothing of the
/// source over its zones, nor the noise of its gloss.
class GatherEstimator : public HemisphereEstimator {
 public:
  GatherEstimator(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
                  const RecordOptions& resolved, std::uint64_t seed);
  ~GatherEstimator() override;
  std::unique_ptr<Worker> make_worker() const override;
  Made make(const RecordSite& site, Worker& worker) const override;
  std::vector<SeenPass> last_seen(const Worker& worker) const override;
  Made record_from(const RecordSite& site, std::span<const Hemisphere> passes, Worker& worker) const override;

  /// One stratified hemisphere of about `rays` rays, traced and lit, of which make() makes a record.
  void sample(const RecordSite& site, std::int64_t rays, std::uint32_t pass, Hemisphere& h, Worker& worker,
              Measure measure = Measure::projected) const;
  /// What the worker's last sample() of a pass found; `h` is the hemisphere that it filled.
  static SeenPass seen(const Worker& worker, std::uint32_t pass, const Hemisphere& h);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline estimate
