// Pixels in which one surface ends and another begins.
#pragma once

#include <cstdint>
#include <vector>

#include "splat/gbuffer.h"

namespace phos::inline splat {

/// Indices, ascending, of the pixels of which a neighbour (left, right, above, below) shows another material,
/// nothing, a normal more than 15 degrees off, a place off the pixel's own surface, or a large triangle of
/// the same plane that shares no corner: something narrower than a pixel may stand between the two.
std::vector<std::uint32_t> edge_pixels(const Scene& scene, const GBuffer& gbuffer);

}  // namespace phos::inline splat
