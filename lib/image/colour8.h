// 8-bit colours and pictures of one colour.
#pragma once

#include <array>
#include <cstdint>

#include "image/image.h"

namespace phos::inline image {

using Colour8 = std::array<std::uint8_t, 3>;

/// 8-bit sRGB of linear components (clamped to 0 .. 1; IEC 61966-2-1).
Colour8 to_srgb(const Rgb& linear);

/// width, height > 0.
Picture make_picture(int width, int height, const Colour8& colour);

}  // namespace phos::inline image
