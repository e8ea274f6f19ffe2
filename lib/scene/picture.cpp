#include "scene/picture.h"

#include <cmath>

#include "core/error.h"
#include "core/sampling.h"

namespace phos {

void resolve_size(const Camera& camera, std::int64_t longer_side, std::int64_t& width, std::int64_t& height) {
  constexpr double kMostPixels = 0x1p28;
  const double aspect =
      camera.aspect > 0 && std::isfinite(camera.aspect) ? static_cast<double>(camera.aspect) : 1;
  const auto rounded = [](double pixels) {
    return static_cast<std::int64_t>(std::fmin(std::fmax(std::round(pixels), 1), 1e9));
  };
  if (width == 0 && height == 0) (aspect >= 1 ? width : height) = longer_side;
  if (width == 0) width = rounded(static_cast<double>(height) * aspect);
  if (height == 0) height = rounded(static_cast<double>(width) / aspect);
  if (static_cast<double>(width) * static_cast<double>(height) > kMostPixels) {
    throw Error(ExitCode::usage, "--width", text(width, " x ", height, " pixels are too many; at most 2^28"));
  }
}

Vec2 subpixel_offset(int sample) { return r2_point(sample, Vec2(0.5f)); }

}  // namespace phos
