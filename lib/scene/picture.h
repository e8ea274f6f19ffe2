// Size of a picture, and where its pixels are sampled.
#pragma once

#include <cstdint>

#include "core/vector.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// Longer side, pixels, of a picture drawn from a cache, where no size is given; and of the view that a cache
/// is made for.
inline constexpr std::int64_t kPictureSide = 1000;

/// Fills in a width or height of 0 from the other and the camera's aspect; where both are 0, the longer side
/// gets `longer_side` pixels. Throws Error(usage) for a picture of more than 2^28 pixels.
void resolve_size(const Camera& camera, std::int64_t longer_side, std::int64_t& width, std::int64_t& height);

/// Where sample i of n of a pixel lies in it, in [0,1)^2: half of them along an additive R2 sequence, then
/// their mirror images about the centre, in the same order; if n is odd, the centre before. So their mean is
/// the centre, and pictures do not shift with their number. And samples i and i + n / 2, which lie opposite
/// each other, have nearly the same Sobol' points of a lamp where n is a power of two: place and lamp do not
/// go together.
Vec2 subpixel_offset(int i, int n);
/// Of sample i of n more of a pixel that has `before` already: further points of that sequence, and, but of
/// the last one if n is odd, their mirror images.
Vec2 further_offset(int i, int n, int before);

}  // namespace phos::inline scene
