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
#include "radiance/cache.h"
#include "scene/rays.h"

namespace phos::inline place {

enum class Place {
  automatic,  ///< given points, or photons, or every surface: the first that there is
  photons,    ///< where photons landed
  given,      ///< given points that no record covers yet
  every,      ///< every given point, covered or not
  view,       ///< what a camera sees
  surface,    ///< every surface of the scene, lit or not
};

struct PlacementOptions {
  std::int64_t max_candidates = 0;  ///< photons tried; 0: all
  std::int64_t passes = 4;  ///< over the candidates; later ones cover what neighbour clamping uncovered
  Place place = Place::automatic;
  std::string camera{};                ///< of view: "" = the scene's first
  std::int64_t width = 0, height = 0;  ///< of view, pixels; 0: as resolve_size() says
  /// Of view: as the camera sees it. Not given: 1 / accuracy, which makes no record serve less than a pixel.
  std::optional<double> min_radius_pixels{};
  double max_radius_pixels = 0;  ///< of view; 0: no bound
  std::string part{};            ///< of every: "k/n", or empty: all
  /// Of surface, by gathered rays: root mean square error aimed at, of the mean; empty: radii by the rules of
  /// RecordOptions alone.
  std::optional<double> error{};
};

void declare_options(Options& options, PlacementOptions& placement);
/// All but --part and --placement-error.
void declare_place_options(Options& options, PlacementOptions& placement);

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
/// Error(usage) for what does not go together: photons or points that are not there, points that nobody
/// reads, part without every, bounds the wrong way round.
void resolve(PlacementOptions& placement, const Scene& scene, const PlacementSource& source, double accuracy);

struct PlacementReport {
  std::uint64_t candidates = 0, made = 0, kept = 0, uncovered = 0;
  std::uint64_t passes = 0, clamped_to_neighbour = 0, clamped_to_least = 0;
  double making_s = 0;  ///< wall time spent in making records
  // Of surface.
  std::uint64_t sides = 0, sides_inside = 0;  ///< of triangles; those in solids, where nothing is placed
  /// By fresh points, of what light can reach: of its area, and with each triangle counting alike, so that
  /// small things beside large ones count too.
  std::optional<double> uncovered_share, uncovered_share_of_triangles;
  /// What the new records stand for, in their order, where the estimator makes radiance records.
  std::vector<RadianceRecord> radiance;
  std::vector<Made> made_records;  ///< the new records as they were made, in their order
};

/// Adds records to `cache` (whose own stay as they are, first and unchanged) as the resolved options say; all
/// but options.part, which is make_part()'s. Same records for any number of threads.
PlacementReport extend_cache(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                             const RecordOptions& records, const PlacementOptions& placement,
                             const PlacementSource& source, Counters& counters);

/// Adds records until they cover the candidates. They are made in parallel in batches of a size that depends
/// on nothing but the batches before, and accepted one after another where nothing covers them yet.
PlacementReport place_records(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                              const RecordOptions& resolved, const PlacementOptions& placement,
                              const Candidates& candidates, Counters& counters);

/// Adds a record at each point (with `wanted`, of those materials), covered or not.
PlacementReport place_every(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                            const RecordOptions& resolved, std::span<const SurfaceSample> points,
                            Counters& counters, const MaterialFilter& wanted = {});

/// Covers every surface that is not purely specular, from both sides, but for sides inside of solids.
/// Triangles are halved until each piece lies within the reach of one record or is small beside it; a
/// record is made at the middle of a piece that nothing covers. Repeated, since neighbours shrink each
/// other's reach, until a pass finds less than kSurfaceShare of the area open, or `passes` are done. With
/// `wanted`, surfaces of other materials are none. With placement.error, records start far apart and come
/// nearer to each other where they foretell each other wrongly (Refinement), kErrorPasses times at most;
/// their gradients then follow from their neighbours too.
PlacementReport place_on_surfaces(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                                  const RecordOptions& resolved, const PlacementOptions& placement,
                                  Counters& counters, const MaterialFilter& wanted = {});
inline constexpr double kSurfaceShare = 1e-4;
inline constexpr int kErrorPasses = 10;

class Growth;
class ParallelMaker;
/// Ends a placement: final radii into the cache, figures into the report, events into the counters.
void finish_placement(Growth& growth, const ParallelMaker& maker, IrradianceCache& cache,
                      PlacementReport& report, Counters& counters);

}  // namespace phos::inline place
