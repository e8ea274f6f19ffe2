// The common part of estimators of radiance records: from a sampled hemisphere to the record.
#pragma once

#include <span>

#include "estimate/gather_source.h"
#include "estimate/radiance_record.h"

namespace phos::inline scene {
class RayScene;
}

namespace phos::inline estimate {

/// Sets the random numbers of radiance records apart from the numbers of irradiance records at the same
/// places.
inline constexpr std::uint64_t kRadianceStreams = 0x72616469616e6365;

/// Const, usable from any thread; holds references.
struct HemisphereRadiance {
  const RayScene& rays;
  RecordOptions options;  ///< resolved
  RadianceGradient gradient;
  GatherSource source;

  /// The record of a hemisphere at a site, as Made::radiance. Its radius is limited by its surroundings
  /// (reach_m) and the surface next to it. `borders`: of an unstructured hemisphere (RayBorder). Where
  /// records are to have footprints, axes that are off by more than rho at their least length are counted
  /// (kUnresolvedEvent).
  Made record(const RecordSite& site, const Hemisphere& h, std::span<const RayBorder> borders,
              RadianceProjector& projector, Counters& counters) const;

 private:
  void fit(const RecordSite& site, const Hemisphere& h, RadianceRecord& record, Counters& counters) const;
};

}  // namespace phos::inline estimate
