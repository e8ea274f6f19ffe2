// How many rays a picture's direct light and gloss take for an asked noise.
#pragma once

#include "splat/picture/render.h"

namespace phos::inline splat {

/// What was found.
struct NoiseTarget {
  /// Noise of direct light and of gloss in the small pictures, over the light of the pixel, or over a tenth
  /// of the picture's mean where that is more: root mean square.
  double direct = 0, gloss = 0;
  Doublings doublings;  ///< empty where no pixel needs any
  bool enough = true;   ///< false: more than a fiftieth of the pixels would need more rays than are ever sent
};

/// Sets light_samples and gloss_samples of resolved options, and how often noisy pixels double them, such
/// that in every pixel each brings about half of the variance of `noise`, relative as above. Emission does
/// not count as light. Two small pictures of other random numbers tell, by the mean square of their
/// differences in the 5 x 5 pixels about a place. Rays of independent noise are assumed: where they are
/// stratified, the noise falls below the target. No fewer than those pictures have: 64, to each of n lamps of
/// an extent 64 / sqrt(n), at least 4; and at most 4096. Nothing where noise is not asked for.
NoiseTarget choose_rays(const RayScene& rays, const IrradianceCache& cache, RenderOptions& render,
                        std::span<const BrdfTable> brdfs, const GlossCache* gloss);

/// Throws Error(usage) where `noise` comes with a number of rays, or with shadow maps.
void require_one_choice(const Options& given, const RenderOptions& render);

}  // namespace phos::inline splat
