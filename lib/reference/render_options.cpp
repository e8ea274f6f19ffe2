#include "reference/render_options.h"

#include "scene/limits.h"
#include "scene/picture.h"

namespace phos::inline reference {

void declare_options(Options& options, ReferenceOptions& r) {
  options.section("Picture");
  options.text("camera", r.camera, "NAME", "camera of the scene (default: the first one)");
  options.integer("width", r.width, "PIXELS",
                  "width of the picture; 0: from the height and the camera's aspect",
                  {0, kMostPictureSide.as<double>()});
  options.integer("height", r.height, "PIXELS",
                  "height of the picture; 0: from the width; both 0: 512 on the longer side",
                  {0, kMostPictureSide.as<double>()});
  options.flag("illuminance", r.illuminance,
               "also write the layer illuminance.Y in lx, by one more path for each sample");
  options.section("Light");
  options.integer("samples", r.samples, "N",
                  "number of paths for each pixel or point; with --error the largest number",
                  {1, 4294967295.0});
  options.number("error", r.error, "FRACTION",
                 "relative standard error at which the work stops: the RMS standard error of the pixels' "
                 "scattered light over its mean (0.01: 1 %); with --points, the standard error of each point "
                 "over its value (default: all --samples are taken)",
                 kPositive);
  declare_method(options, r.method, "", MethodChoice::all);
  options.flag("adaptive", r.adaptive,
               "--samples becomes a mean: a quarter of the samples tells the noise about each pixel, and "
               "noisier pixels get more of the rest. Pictures stay unbiased, and are far less noisy where a "
               "few bright pixels have most of the noise");
  options.integer("bounces", r.path.bounces, "N",
                  "largest number of scatterings between light and eye, including the seen surface (or the "
                  "sensor): 0: emission alone; 1: direct light; 2: one indirect bounce; -1: all",
                  {-1, 65000});
  options.flag("black-emitters", r.path.black_emitters,
               "emitting surfaces reflect nothing, as in some other renderers");
  declare_options(options, r.map);
}

void resolve_size(ReferenceOptions& r, const Camera& camera) {
  constexpr int kLongerSide = 512;  // pixels
  resolve_size(camera, kLongerSide, r.width, r.height);
}

}  // namespace phos::inline reference
