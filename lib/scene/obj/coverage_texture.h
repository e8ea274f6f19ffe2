// One texture of colour and coverage from two images.
#pragma once

#include "scene/scene.h"

namespace phos::inline scene {

/// Which value of an image is a coverage: its alpha where any texel is not opaque, else its luminance; or one
/// channel.
enum class CoverageOf : std::uint8_t { alpha_or_luminance, red, green, blue, luminance };

/// Colours of `colour` (null: white), the coverage in alpha. Sampled as `colour` is, or as `coverage` where
/// there is no colour; of the larger size of both in each direction, or, where that is above 2^26 texels, of
/// the one that has more.
Texture with_coverage(const Texture* colour, const Texture& coverage, CoverageOf channel);
/// The colours alone: alpha is 1.
Texture without_alpha(const Texture& colour);
/// Is any texel not opaque?
bool has_alpha(const Texture& texture);

}  // namespace phos::inline scene
