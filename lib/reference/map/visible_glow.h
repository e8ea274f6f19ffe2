// Lamps and environment as an eye sees them.
#pragma once

#include "reference/eye_path_tracer.h"
#include "reference/map/specular_walk.h"
#include "scene/lamp/luminaires.h"

namespace phos::inline reference {

/// Adds the light that the surface emits back along an eye's walk, which has come to `stop`; without a
/// surface the environment's light.
inline void add_visible_glow(const Scene& scene, const SpecularStop& stop, const SurfacePoint* point,
                             PathSample& sum) {
  const Rgb luminance =
      point ? emitted_luminance(scene, *point, -stop.direction) : background_luminance(scene, stop.direction);
  (stop.passed ? sum.specular : sum.emission) += stop.throughput * luminance;
}

}  // namespace phos::inline reference
