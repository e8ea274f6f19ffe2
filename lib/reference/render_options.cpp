#include "reference/render_options.h"

#include "scene/limits.h"
#include "scene/picture.h"

namespace phos::inline reference {

void declare_options(Options& options, ReferenceOptions& r) {
  options.section("Picture");
  options.text("camera", r.camera, "NAME", "camera of the scene; the first one if not given");
  options.integer("width", r.width, "PIXELS", "width; 0: from the height and the camera's aspect",
                  {0, kMostPictureSide.as<double>()});
  options.integer("height", r.height, "PIXELS", "height; 0: from the width; both 0: 512 on the longer side",
                  {0, kMostPictureSide.as<double>()});
  options.flag("illuminance", r.illuminance, "also the layer illuminance.Y, lx, by one more path a sample");
  options.section("Light");
  options.integer("samples", r.samples, "N", "paths a pixel (or a point); the most, if --error is given",
                  {1, 4294967295.0});
  options.number("error", r.error, "FRACTION",
                 "stop once the RMS standard error of the pixels' scattered light is this part of its mean "
                 "(0.01: 1 %); with --points, once each point's standard error is this part of its value",
                 kPositive);
  declare_method(options, r.method, "", MethodChoice::all);
  options.flag("adaptive", r.adaptive,
               "--samples are a mean: a quarter of them tell how noisy each pixel's neighbours are, and the "
               "noisier, the more of the rest it gets; still unbiased, and far less noisy where a few bright "
               "pixels have most of the noise");
  options.integer("bounces", r.path.bounces, "N",
                  "scatterings between light and eye, the visible surface's (or the sensor's) included: 0 "
                  "emission only, 1 "
                  "direct light, 2 one indirect bounce; -1: all",
                  {-1, 65000});
  options.flag("black-emitters", r.path.black_emitters,
               "surfaces that emit reflect nothing, as in some other renderers");
  declare_options(options, r.map);
}

void resolve_size(ReferenceOptions& r, const Camera& camera) {
  constexpr int kLongerSide = 512;  // pixels
  resolve_size(camera, kLongerSide, r.width, r.height);
}

}  // namespace phos::inline reference
