// Size of a picture, and where its pixels are sampled.
#pragma once

#include <cstdint>

#include "core/vector.h"
#include "scene/scene.h"

namespace phos {

/// Longer side, pixels, of a picture drawn from a cache, where no size is given; and of the view that a cache
/// is made for.
inline constexpr std::int64_t kPictureSide = 1000;

/// Fills in a width or height of 0 from the other and the camera's aspect; where both are 0, the longer side
/// gets `longer_side` pixels. Throws Error(usage) for a picture of more than 2^28 pixels.
void resolve_size(const Camera& camera, std::int64_t longer_side, std::int64_t& width, std::int64_t& height);

/// Where sample 0, 1, ... of a pixel lies in it, in [0,1)^2: the centre, then the additive R2 sequence from
/// there.
Vec2 subpixel_offset(int sample);

}  // namespace phos
