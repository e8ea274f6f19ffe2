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
      "places that need records: photons: where photons landed; given: points of --at that no record covers "
      "yet; every: every point of --at; view: the surfaces that a camera sees; surface: every surface; auto: "
      "given with --at, else photons if there are any, else surface");
  options.integer("max-candidates", p.max_candidates, "N",
                  "number of photons tried as places for records; 0: all", {0, 1e12});
  options.integer("passes", p.passes, "N", "largest number of passes over the candidates", {1, 100});
  options.text("camera", p.camera, "NAME", "with --place view: camera of the scene (default: the first one)");
  options.integer("width", p.width, "PIXELS",
                  "with --place view: width of the picture; 0: from the height and the camera's aspect",
                  {0, kMostPictureSide.as<double>()});
  options.integer(
      "height", p.height, "PIXELS",
      "with --place view: height of the picture; 0: from the width; both 0: 1000 on the longer side",
      {0, kMostPictureSide.as<double>()});
  options.number("min-radius-pixels", p.min_radius_pixels, "PIXELS",
                 "with --place view: smallest radius of a record in the picture; it goes down to a quarter "
                 "where indirect light is more than twice its mean over the scene; 0: no bound (default: 1 / "
                 "accuracy, so that elsewhere no record serves less than a pixel)",
                 kNotNegative);
  options.number(
      "max-radius-pixels", p.max_radius_pixels, "PIXELS",
      "with --place view: largest radius of a record in the picture (10 to 20 is usual); 0: no bound",
      kNotNegative);
}

void declare_options(Options& options, PlacementOptions& p) {
  declare_place_options(options, p);
  options.number(
      "placement-error", p.error, "E",
      "with --estimate gather --place surface: root mean square error to reach, about, as a share of the "
      "mean irradiance. Records stand far apart at first, and closer where neighbours predict each other's "
      "light wrongly, in at most 10 passes (or --passes, if more). More --rays allow a smaller E; accuracy "
      "is 1/3 if not given (default: 0.05, unless --accuracy or --add-to sets the density)",
      {1e-4, 1}, Recorded::unless_default);
  options.text("part", p.part, "K/N",
               "with --place every: make only part K of N of the records; phos-merge joins the parts exactly",
               Recorded::no);
}

}  // namespace phos::inline place
