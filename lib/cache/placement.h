// Where records are placed (thesis, algorithm 6): candidates are tried until a record covers each.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cache/estimator.h"
#include "cache/record_options.h"
#include "core/options.h"
#include "photon/photon_map.h"
#include "scene/rays.h"

namespace phos {

struct SurfaceSample {
  Vec3 position{0}, normal{0, 0, 1};
};

/// Places that must be covered, in the order in which they are tried.
struct Candidates {
  std::size_t count = 0;
  std::function<RecordSite(std::size_t)> site;  ///< of candidate i < count; may be called from any thread
};

/// Where the wanted photons landed, in an order that depends on the seed alone; `most` of them (0: all).
Candidates photon_candidates(const PhotonMap& photons, Quantity wanted, std::uint64_t seed,
                             std::int64_t most);
/// Points in the order given. Holds a reference to them.
Candidates point_candidates(std::span<const SurfaceSample> points);

struct PlacementOptions {
  std::int64_t max_candidates = 0;  ///< photons tried; 0: all
  std::int64_t passes = 4;  ///< over the candidates; later ones cover what neighbour clamping uncovered
};

struct PlacementReport {
  std::uint64_t candidates = 0, made = 0, kept = 0, uncovered = 0;
  std::uint64_t passes = 0, clamped_to_neighbour = 0, clamped_to_least = 0;
  double making_s = 0;  ///< wall time spent in making records
};

void declare_options(Options& options, PlacementOptions& placement);

/// Adds records to `cache` (whose own stay as they are, first and unchanged) until they cover the candidates.
/// Candidates are made in parallel in batches of a size that depends on nothing but the batches before, and
/// accepted one after another where nothing covers them yet. Same records for any number of threads.
PlacementReport place_records(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                              const RecordOptions& resolved, const PlacementOptions& placement,
                              const Candidates& candidates, Counters& counters);

/// Points from CSV with a header naming x,y,z (m) and nx,ny,nz in any order among other columns; "x [m]" and
/// "x_m" are read as x. '#' starts a comment line. Throws Error(bad_input) naming line and column.
std::vector<SurfaceSample> read_points(const std::string& path);

}  // namespace phos
