// Where records are placed (Gautron 2006, algorithm 6; docs/methods.md#p1): candidates are tried until a
// record covers each.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/options.h"
#include "estimate/estimator.h"
#include "estimate/record_options.h"
#include "photon/photon_map.h"
#include "place/candidates.h"
#include "place/placement_options.h"
#include "radiance/cache.h"
#include "scene/rays.h"

namespace phos::inline place {

struct PlacementReport {
  std::uint64_t candidates = 0, made = 0, kept = 0, uncovered = 0;
  std::uint64_t passes = 0, clamped_to_neighbour = 0, clamped_to_least = 0;
  double making_s = 0;  ///< wall time spent in making records
  // Of surface.
  std::uint64_t sides = 0, sides_inside = 0;  ///< of triangles; those in solids, where nothing is placed
  /// By fresh points on the surface in reach of light: by area, and with each triangle counting alike, so
  /// that small objects beside large ones count too.
  std::optional<double> uncovered_share, uncovered_share_of_triangles;
  /// What the new records stand for, in their order, where the estimator makes radiance records.
  std::vector<RadianceRecord> radiance;
  std::vector<Made> made_records;  ///< the new records as they were made, in their order
};

/// Adds records until they cover the candidates. They are made in parallel in batches of a size that depends
/// on nothing but the batches before, and accepted one after another where nothing covers them yet.
PlacementReport place_records(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                              const RecordOptions& resolved, const PlacementOptions& placement,
                              const Candidates& candidates, Counters& counters);

/// Adds a record at each point (with `wanted`, of those materials), covered or not.
PlacementReport place_every(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                            const RecordOptions& resolved, std::span<const SurfaceSample> points,
                            Counters& counters, const MaterialFilter& wanted = {});

class Growth;
class ParallelMaker;
/// Ends a placement: final radii into the cache, figures into the report, events into the counters.
void finish_placement(Growth& growth, const ParallelMaker& maker, IrradianceCache& cache,
                      PlacementReport& report, Counters& counters);

}  // namespace phos::inline place
