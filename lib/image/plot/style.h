// How plots look.
#pragma once

#include <algorithm>

#include "image/canvas.h"

namespace phos::inline image {

inline constexpr Colour8 kPaper{255, 255, 255}, kInk{40, 40, 40};

/// Told apart by people of any colour vision (Okabe and Ito 2008), black last.
inline constexpr Colour8 kLineColours[] = {{0, 114, 178}, {213, 94, 0},   {0, 158, 115}, {204, 121, 167},
                                           {230, 159, 0}, {86, 180, 233}, {150, 90, 40}, {0, 0, 0}};

/// Size of letters beside or on a picture of that height, pixels.
inline int letters_of_picture(int height) { return std::clamp(height / 30, 12, 200); }

}  // namespace phos::inline image
