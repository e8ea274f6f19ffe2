// How fast differences within pixels shrink with the pixels.
#pragma once

#include <string>

#include "image/image.h"

namespace phos::inline plan {

/// Power h of the mean square of differences within pixels, as N^-h of the number N of pixels: 1 for smooth
/// light, 1/2 for lone edges, of which each pixel row shows as many whatever its height, next to nothing for
/// textures and mouldings that go on below a pixel. Taken from how much the pixels of blocks of 2 x 2 and of
/// 4 x 4 differ in a pair of pictures of one view (from products of the two, so that their noise is not in
/// it), lamps left out: if the mean square within a square of side b goes as b^2h, the second is 2^2h + 1
/// times the first. From calibration::kLeastDetailPower (nothing is known, or detail is everywhere) to 1.
double detail_power(const Image& a, const Image& b);

/// Mean square by which a layer of two pictures differs, over the square of its mean in the second: with few
/// and with more samples in each pixel, the part within pixels that the few samples miss. 0 where it is dark.
double differs_within_pixels(const Image& few, const Image& more, const std::string& layer);

}  // namespace phos::inline plan
