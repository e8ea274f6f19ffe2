// How many rays a picture's direct light and gloss take for an asked noise.
#pragma once

#include "splat/picture/render.h"

namespace phos::inline splat {

/// What was found.
struct NoiseTarget {
  /// Noise of direct light and of gloss in the small pictures, over the light of the pixel, or over a tenth
  /// of the picture's mean where that is more: root mean square.
  double direct = 0, gloss = 0;
  bool enough = true;  ///< false: more rays than are ever sent would be needed
};

/// Sets light_samples and gloss_samples of resolved options such that each brings half of the variance of
/// `noise`, a root mean square of the same kind. Emission does not count as light. Two small pictures of
/// other random numbers tell: their differences, but for the largest fiftieth, which are of edges. Rays of
/// independent noise are assumed: where they are stratified, the noise falls below the target. No
/// fewer than those pictures have: 64, to each of n lamps of an extent 64 / sqrt(n), at least 4; and at most
/// 4096. Nothing where noise is not asked for.
NoiseTarget choose_rays(const RayScene& rays, const IrradianceCache& cache, RenderOptions& render,
                        std::span<const BrdfTable> brdfs, const GlossCache* gloss);

/// Throws Error(usage) where `noise` comes with a number of rays, or with shadow maps.
void require_one_choice(const Options& given, const RenderOptions& render);

}  // namespace phos::inline splat
