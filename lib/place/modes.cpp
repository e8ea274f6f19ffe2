#include "place/modes.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "file/shards.h"
#include "place/on_surfaces.h"
#include "place/placement.h"
#include "place/placement_options.h"
#include "place/view_candidates.h"
#include "scene/load.h"
#include "scene/picture.h"

namespace phos::inline place {
namespace {

View view_of(const PlacementOptions& p, const Scene& scene) {
  return {find_camera(scene, p.camera), p.width, p.height, p.min_radius_pixels.value(), p.max_radius_pixels};
}

}  // namespace

void resolve(PlacementOptions& p, const Scene& scene, const PlacementSource& source, double accuracy) {
  const auto refuse = [](const char* option, const std::string& message) {
    throw Error(ExitCode::usage, option, message);
  };
  if (p.place == Place::automatic) {
    p.place = source.points_given ? Place::given : source.photons ? Place::photons : Place::surface;
  }
  const bool at_points = p.place == Place::given || p.place == Place::every;
  if (p.place == Place::photons && !source.photons)
    refuse("--place", "photons needs a photon map among the inputs; give the output of phos-photons too");
  if (at_points && !source.points_given)
    refuse("--place", "given and every need points; give them with --at FILE");
  if (!at_points && source.points_given)
    refuse("--at", "is not read by this --place; use --place given or every, or leave --at out");
  if (!p.part.empty() && p.place != Place::every) refuse("--part", "needs --place every; add that option");
  parse_share("--part", p.part);
  if (p.error && p.place != Place::surface)
    refuse("--placement-error", "needs --place surface; add that option");
  if (p.place != Place::view) {
    const bool least = p.min_radius_pixels.value_or(0) > 0;
    if (least || p.max_radius_pixels > 0)
      refuse(least ? "--min-radius-pixels" : "--max-radius-pixels",
             "needs --place view, which has pixels; give metres by --min-radius and --max-radius instead");
    return;
  }
  const double most = p.max_radius_pixels > 0 ? p.max_radius_pixels : std::numeric_limits<double>::infinity();
  if (!p.min_radius_pixels) p.min_radius_pixels = std::min(1 / accuracy, most);
  if (*p.min_radius_pixels > most)
    refuse("--min-radius-pixels", "is above --max-radius-pixels; give a smaller value");
  resolve_size(find_camera(scene, p.camera), kPictureSide, p.width, p.height);
}

PlacementReport extend_cache(IrradianceCache& cache, const Estimator& estimator, const RayScene& rays,
                             const RecordOptions& records, const PlacementOptions& placement,
                             const PlacementSource& source, Counters& counters) {
  const auto by = [&](Candidates candidates) {
    if (source.wanted && placement.place != Place::view)
      candidates = on_materials(rays, source.wanted, std::move(candidates));
    return place_records(cache, estimator, rays, records, placement, candidates, counters);
  };
  switch (placement.place) {
    case Place::photons:
      return by(photon_candidates(*source.photons, Counted(records), source.seed, placement.max_candidates));
    case Place::given:
      return by(point_candidates(source.points));
    case Place::every:
      return place_every(cache, estimator, rays, records, source.points, counters, source.wanted);
    case Place::view:
      return by(view_candidates(rays, view_of(placement, rays.scene()), source.wanted));
    case Place::surface:
      return place_on_surfaces(cache, estimator, rays, records, placement, counters, source.wanted);
    case Place::automatic:
      break;
  }
  PHOS_CHECK(false, "resolve() first");
}

}  // namespace phos::inline place
