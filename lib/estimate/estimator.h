// What makes an irradiance record: the seam between placement and the ways of estimating irradiance.
#pragma once

#include <cstdint>
#include <memory>

#include "core/counters.h"
#include "record/irradiance_cache.h"

namespace phos::inline radiance {
struct RadianceRecord;
}

namespace phos::inline estimate {

inline constexpr std::uint32_t kNoPhoton = ~0u;

/// A place where a record is wanted.
struct RecordSite {
  Vec3 position{0}, normal{0, 0, 1};  ///< m, on a surface; unit, on the side that is lit
  std::uint64_t item = 0;             ///< numbers its random rays
  std::uint32_t photon = kNoPhoton;   ///< row of the photon that it sits on, or kNoPhoton
  float tried = 1;                    ///< with a photon: the part of such photons that are candidates
  float least_radius_m = 0,
        most_radius_m = kInfinity;  ///< this place's own bounds of the radius (pixel size)
};

/// A record one frame on, as an estimator that looks ahead expects it.
struct Ahead {
  IrradianceRecord record;                           ///< place, normal and gradients belong to that time
  std::shared_ptr<const RadianceRecord> radiance{};  ///< where radiance records are made
  float holes = 0;  ///< share of its hemisphere that nothing seen now leads to
};

/// A record before its neighbours and the bounds of the radius had their say.
struct Made {
  IrradianceRecord record;  ///< radius_m after gradient and edge limits: finite, positive, not clamped
  /// Neighbours need not clamp it further, since records nearer to each other than their photons reach would
  /// tell the same photons' tale.
  float least_radius_m = 0;
  float site_least_m = 0, site_most_m = kInfinity;  ///< of its RecordSite
  /// What it stands for, where radiance records are placed: `record` is then irradiance_of() that.
  std::shared_ptr<const RadianceRecord> radiance{};
  std::shared_ptr<const Ahead> ahead{};
  std::uint64_t item = 0;     ///< of its RecordSite (set by ParallelMaker)
  float least_share = 1;      ///< of site_least_m that counts here (GatherSource)
  float light_m = kInfinity;  ///< harmonic mean distance that the light comes from, where it is to count
};

/// One way of estimating irradiance. Const and usable from any thread, each with a worker of its own.
class Estimator {
 public:
  /// Memory and counts of one thread.
  class Worker {
   public:
    virtual ~Worker() = default;
    Counters counters;  ///< numerical events so far
  };
  virtual ~Estimator() = default;
  virtual std::unique_ptr<Worker> make_worker() const = 0;
  /// The record at a site; `worker` is of this estimator. Depends on the site and the seed alone. Always
  /// finite. Throws Error(numerical) where a value exceeds the range of numbers.
  virtual Made make(const RecordSite& site, Worker& worker) const = 0;
  /// The irradiance of that record alone, lx: light that it does not need is neither looked for nor counted.
  virtual Rgb irradiance_lx(const RecordSite& site, Worker& worker) const {
    return make(site, worker).record.irradiance;
  }
  /// One whose hands are tied to the thread that made it (OpenGL).
  virtual bool one_thread() const { return false; }
};

}  // namespace phos::inline estimate
