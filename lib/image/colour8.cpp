#include "image/colour8.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace phos::inline image {

Colour8 to_srgb(const Rgb& linear) {
  Colour8 out;
  for (int i = 0; i < 3; ++i) {
    const float v = std::clamp(linear[i], 0.0f, 1.0f);
    const float s = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
    out[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(255 * s + 0.5f);
  }
  return out;
}

Picture make_picture(int width, int height, const Colour8& colour) {
  PHOS_CHECK(width > 0 && height > 0, width, " x ", height);
  Picture p{width, height, {}};
  p.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < p.rgb.size(); ++i) p.rgb[i] = colour[i % 3];
  return p;
}

}  // namespace phos::inline image
