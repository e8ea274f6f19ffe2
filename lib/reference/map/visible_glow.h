// What an eye sees shine.
#pragma once

#include "reference/eye_path_tracer.h"
#include "reference/map/specular_walk.h"
#include "scene/lamp/luminaires.h"

namespace phos::inline reference {

/// Adds what the surface emits towards an eye whose ray came to it as `stop` says; where there is none, the
/// environment beyond.
inline void add_visible_glow(const Scene& scene, const SpecularStop& stop, const SurfacePoint* point,
                             PathSample& sum) {
  const Rgb luminance =
      point ? emitted_luminance(scene, *point, -stop.direction) : background_luminance(scene, stop.direction);
  (stop.passed ? sum.specular : sum.emission) += stop.throughput * luminance;
}

}  // namespace phos::inline reference
