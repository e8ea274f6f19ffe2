// Drawing on an 8-bit picture: rectangles and small text, for legends.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "image/image.h"

namespace phos::inline image {

using Colour8 = std::array<std::uint8_t, 3>;

/// 8-bit sRGB of linear components (clamped to 0 .. 1; IEC 61966-2-1).
Colour8 to_srgb(const Rgb& linear);

Picture make_picture(int width, int height, const Colour8& colour);
/// Outside of the picture nothing is drawn.
void set_pixel(Picture& picture, int x, int y, const Colour8& colour);
void fill(Picture& picture, int x, int y, int width, int height, const Colour8& colour);

/// Letters are 5 x 7 dots, `dot` pixels each. Lower case, capitals, digits and . , : - + / % ( ) = < > _ [ ]
/// ^ * and, in Latin-1 or UTF-8, the degree sign and the superscript two ("\xb2" in Latin-1, which
/// text_for_picture makes of "m2"); another character leaves a blank.
void draw_text(Picture& picture, int x, int y, int dot, std::string_view text, const Colour8& colour);
int text_width(std::string_view text, int dot);
int text_height(int dot);
/// "cd/m2" with a raised two.
std::string text_for_picture(std::string unit);

}  // namespace phos::inline image
