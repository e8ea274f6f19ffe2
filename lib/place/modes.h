// The modes of placement: the options that go with each, and the choice.
#pragma once

#include <cstdint>
#include <span>

#include "photon/photon_map.h"
#include "place/placement.h"

namespace phos::inline place {

/// What placement may read besides the scene.
struct PlacementSource {
  const PhotonMap* photons = nullptr;
  bool points_given = false;
  std::span<const SurfaceSample> points{};
  std::uint64_t seed = 0;  ///< of the order in which photons are tried
  /// Materials that want records; empty: all surfaces that light can land on (of views: diffuse ones).
  MaterialFilter wanted{};
};

/// Fills in place, and width, height and least radius of a view, whose records have this accuracy. Throws
/// Error(usage) for options that do not go together: photons or points that are not there, points that nobody
/// reads, part without every, bounds the wrong way round.
void resolve(PlacementOptions& placement, const Scene& scene, const PlacementSource& source, double accuracy);

/// Adds records to `cache` (whose own stay as they are, first and unchanged) as the resolved options say; all
/// but options.part, which is make_part()'s. Same records for any number of threads.
PlacementReport extend_cache(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                             const RecordOptions& records, const PlacementOptions& placement,
                             const PlacementSource& source, Counters& counters);

}  // namespace phos::inline place
