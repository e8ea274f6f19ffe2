// A shadow map in memory: light from one place on a lamp at any point, without rays. Private to the OpenGL
// sources of this module.
#pragma once

#include <vector>

#include "splat/gl/shadow_maps.h"

namespace phos::inline splat {

/// Light that comes from a place on a lamp.
struct MappedLight {
  Vec3 direction{0};  ///< to the lamp; unit
  Rgb lux{0};         ///< on a surface that faces it, shadow included
};

struct LampMap {
  ShadowSample sample;
  int size = 0;              ///< pixels of a side
  std::vector<float> depth;  ///< of each face

  /// As shaders::shadow_fragment has it. `facet`: geometric normal of the lit surface, on the lit side. The
  /// lit share is the mean over taps x taps texels about the point (percentage-closer filtering, Reeves et
  /// al. 1987). False: no light.
  bool light(const Vec3& position, const Vec3& facet, int taps, MappedLight& light) const;

 private:
  float lit_share(const Vec3& v, const Vec3& n, std::size_t face, int taps) const;
};

}  // namespace phos::inline splat
