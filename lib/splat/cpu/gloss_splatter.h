// Drawing radiance records over a G-buffer: the light that they send towards the eye through glossy lobes.
#pragma once

#include <cstdint>
#include <vector>

#include "radiance/gloss_cache.h"
#include "splat/gbuffer.h"

namespace phos::inline splat {

/// What blending leaves per pixel, before normalisation.
struct GlossBuffer {
  std::vector<Vec4> light;  ///< rgb = sum w L (cd/m2 towards the eye), w = sum w
  /// rgb = sum w x standard error of their mean (blended_error, cd/m2), w = number of records.
  std::vector<Vec4> error;
  float unit = 1;            ///< of light, cd/m2, that keeps squares within the range of floats
  std::uint64_t pairs = 0;   ///< of a pixel and a record, that added light
  std::uint64_t turned = 0;  ///< pixels whose records had to be rotated: looked up instead of drawn
};

/// Every radiance record's weight (at `accuracy`, the cache's) and light, at the pixels whose lobe is
/// read from records (all others stay 0): GlossCache::outgoing to 1e-4, but for rounding on the rim of
/// records. Of `gbuffer`, seen by `camera` through the point `subpixel` of each pixel. Tiled and vectorised;
/// lobes are made for a few pixels at a time. Where records are in other frames than the surface seen (curved
/// ones), the lookup answers. Same bytes for any number of threads.
GlossBuffer splat_gloss_on_cpu(const GlossCache& cache, double accuracy, const RayScene& rays,
                               const GBuffer& gbuffer, const Camera& camera, const Vec2& subpixel);

/// The error of a pixel: sums over its records of w, of w x light (`kept`: with harmonics that ring below the
/// least cut off) and of w x their errors; `sums` in squares of `unit`.
Rgb gloss_error(const BlendSums& sums, float weight, const Rgb& kept, const Rgb& light, const Rgb& error,
                float unit);

/// The result of splatting by lookups alone; without leaks where the cache tests for them.
GlossBuffer look_up_gloss(const GlossCache& cache, const RayScene& rays, const GBuffer& gbuffer,
                          const Camera& camera, const Vec2& subpixel);

}  // namespace phos::inline splat
