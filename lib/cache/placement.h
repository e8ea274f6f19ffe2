// Where records are placed (thesis, algorithm 6): at photons, or at given points, until every one is covered.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cache/record_maker.h"
#include "core/options.h"

namespace phos {

struct SurfaceSample {
  Vec3 position{0}, normal{0, 0, 1};
};

struct PlacementOptions {
  std::int64_t max_candidates = 0;  ///< photons tried; 0: all
  std::int64_t passes = 4;  ///< over the candidates; later ones cover what neighbour clamping uncovered
};

struct PlacementReport {
  std::uint64_t candidates = 0, made = 0, kept = 0, uncovered = 0;
  std::uint64_t passes = 0, clamped_to_neighbour = 0, clamped_to_least = 0;
  double making_s = 0;  ///< wall time spent in making records
};

/// Declares the options of both (names and units as users see them).
void declare_options(Options& options, RecordOptions& records, PlacementOptions& placement);

/// For adding to an earlier file: options that were not given take its values; one that was given and differs
/// throws Error(mismatch) saying which.
void adopt_options(RecordOptions& records, const Options& given, const Container& earlier);

/// Adds records to `cache` (whose own stay as they are, first and unchanged) at `points`, or at photons if
/// `at_photons`, in an order that depends on the seed alone. Candidates are made in parallel in batches of
/// fixed size and accepted one after another where nothing covers them yet. Same records for any number of
/// threads.
PlacementReport place_records(IrradianceCache& cache, const PhotonMap& photons, const RayScene& rays,
                              const RecordOptions& resolved, const PlacementOptions& placement,
                              std::uint64_t seed, std::span<const SurfaceSample> points, bool at_photons,
                              Counters& counters);

/// Points from CSV with a header naming x,y,z (m) and nx,ny,nz in any order among other columns; "x [m]" and
/// "x_m" are read as x. '#' starts a comment line. Throws Error(bad_input) naming line and column.
std::vector<SurfaceSample> read_points(const std::string& path);

}  // namespace phos
