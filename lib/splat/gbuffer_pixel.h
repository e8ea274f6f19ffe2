// Filling a G-buffer, alike by rays and by rasterising.
#pragma once

#include "splat/gbuffer.h"

namespace phos::inline splat {

/// Nothing visible anywhere.
GBuffer empty_gbuffer(int width, int height);
/// What is seen at pixel `i`.
void set_pixel(GBuffer& gbuffer, std::size_t i, const Scene& scene, const Hit& hit,
               const SurfacePoint& point);

}  // namespace phos::inline splat
