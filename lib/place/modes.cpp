// The modes of placement: options, what goes with what, and the choice.
#include <algorithm>
#include <limits>

#include "core/error.h"
#include "file/shards.h"
#include "place/placement.h"
#include "scene/limits.h"
#include "scene/load.h"
#include "scene/picture.h"

namespace phos::inline place {
namespace {

View view_of(const PlacementOptions& p, const Scene& scene) {
  return {find_camera(scene, p.camera), p.width, p.height, p.min_radius_pixels.value(), p.max_radius_pixels};
}

}  // namespace

void declare_place_options(Options& options, PlacementOptions& p) {
  options.section("Placement");
  options.choice<Place>(
      "place", p.place,
      {{"auto", Place::automatic},
       {"photons", Place::photons},
       {"given", Place::given},
       {"every", Place::every},
       {"view", Place::view},
       {"surface", Place::surface}},
      "where records are wanted: where photons landed, at those points of --at that are not "
      "covered yet, at every point of --at, at what a camera sees, or on every surface; "
      "auto: --at, else photons, else surface");
  options.integer("max-candidates", p.max_candidates, "N", "photons tried as places for records; 0: all",
                  {0, 1e12});
  options.integer("passes", p.passes, "N", "passes over the candidates at most", {1, 100});
  options.text("camera", p.camera, "NAME", "with --place view: camera of the scene; the first if not given");
  options.integer("width", p.width, "PIXELS",
                  "with --place view: width; 0: from the height and the camera's aspect",
                  {0, kMostPictureSide.as<double>()});
  options.integer("height", p.height, "PIXELS",
                  "with --place view: height; 0: from the width; both 0: 1000 on the longer side",
                  {0, kMostPictureSide.as<double>()});
  options.number(
      "min-radius-pixels", p.min_radius_pixels, "PIXELS",
      "with --place view: smallest radius as seen there, down to a quarter of it where indirect light is "
      "more than twice its mean over the scene; 0: no such bound (default: 1 / accuracy, so that "
      "elsewhere no record serves less than a pixel)",
      kNotNegative);
  options.number("max-radius-pixels", p.max_radius_pixels, "PIXELS",
                 "with --place view: largest radius as seen there (10 to 20 is usual); 0: no such bound",
                 kNotNegative);
}

void declare_options(Options& options, PlacementOptions& p) {
  declare_place_options(options, p);
  options.number(
      "placement-error", p.error, "E",
      "with --estimate gather --place surface: records far apart at first, and nearer to each other "
      "where they foretell each other's light wrongly, in at most 10 passes (or --passes, if more), "
      "for a root mean square error of about E of the mean irradiance; the --rays of a record bound "
      "E from below; accuracy is 1/3 if not given (default: 0.05, unless --accuracy or --add-to says how "
      "dense they are)",
      {1e-4, 1}, Recorded::unless_default);
  options.text("part", p.part, "K/N",
               "with --place every: make only part K of N of the records; phos-merge joins the parts exactly",
               Recorded::no);
}

void resolve(PlacementOptions& p, const Scene& scene, const PlacementSource& source, double accuracy) {
  const auto refuse = [](const char* option, const std::string& message) {
    throw Error(ExitCode::usage, option, message);
  };
  if (p.place == Place::automatic) {
    p.place = source.points_given ? Place::given : source.photons ? Place::photons : Place::surface;
  }
  const bool at_points = p.place == Place::given || p.place == Place::every;
  if (p.place == Place::photons && !source.photons)
    refuse("--place", "photons needs photons among the inputs; give the output of phos-photons too");
  if (at_points && !source.points_given)
    refuse("--place", "given and every need points; give them with --at FILE");
  if (!at_points && source.points_given)
    refuse("--at", "is not read by this --place; use --place given or every, or leave --at out");
  if (!p.part.empty() && p.place != Place::every) refuse("--part", "goes with --place every alone; add that");
  parse_share("--part", p.part);
  if (p.error && p.place != Place::surface)
    refuse("--placement-error", "goes with --place surface alone; add that");
  if (p.place != Place::view) {
    const bool least = p.min_radius_pixels.value_or(0) > 0;
    if (least || p.max_radius_pixels > 0)
      refuse(
          least ? "--min-radius-pixels" : "--max-radius-pixels",
          "goes with --place view alone, which knows pixels; give metres by --min-radius and --max-radius");
    return;
  }
  const double most = p.max_radius_pixels > 0 ? p.max_radius_pixels : std::numeric_limits<double>::infinity();
  if (!p.min_radius_pixels) p.min_radius_pixels = std::min(1 / accuracy, most);
  if (*p.min_radius_pixels > most)
    refuse("--min-radius-pixels", "is more than --max-radius-pixels; give a smaller one");
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
