// A layer of an image as a table.
#pragma once

#include <string>

#include "image/image.h"

namespace phos::inline image {

/// Comma-separated values with a line of names: x and y of each pixel (from 0, at the top left; row by row),
/// then the layer's channels in their unit, shortest numbers. Throws Error(bad_input) for a layer that is
/// absent.
std::string pixel_csv(const Image& image, const std::string& layer);

}  // namespace phos::inline image
