#include "place/placement_options.h"

#include "scene/limits.h"

namespace phos::inline place {

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

}  // namespace phos::inline place
