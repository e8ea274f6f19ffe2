// Pixels in which one surface ends and another begins.
#pragma once

#include <cstdint>
#include <vector>

#include "splat/gbuffer.h"

namespace phos {

/// Indices, ascending, of the pixels of which a neighbour (left, right, above, below) shows another material,
/// nothing, a normal more than 15 degrees off, or a place off the pixel's own surface.
std::vector<std::uint32_t> edge_pixels(const GBuffer& gbuffer);

}  // namespace phos
