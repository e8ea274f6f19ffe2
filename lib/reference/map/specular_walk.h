// A ray followed by mirrors, glass and panes.
#pragma once

#include "core/random.h"
#include "reference/roulette.h"
#include "scene/material/bsdf.h"
#include "scene/material/passage.h"
#include "scene/rays.h"

namespace phos::inline reference {

/// Where a specular walk has come to.
struct SpecularStop {
  Vec3 direction{0};    ///< of the ray, unit
  Rgb throughput{1};    ///< share of light from here that goes back along the walk
  bool passed = false;  ///< a mirror, glass or a pane was met before
};

/// Follows a ray, at each surface by one of its delta lobes or none, to where no delta lobe sends it on.
/// glow(stop, point) is told of each surface met, and of null where the ray leaves the scene;
/// scatter(stop, point, bsdf) of each surface with other than delta lobes. Ends by Russian roulette.
template <class Glow, class Scatter>
void follow_specular(const RayScene& rays, Ray ray, RandomStream& random, const Glow& glow,
                     const Scatter& scatter) {
  SpecularStop stop;
  for (std::int64_t events = 0;;) {
    Way way(rays, ray);
    stop.direction = ray.direction;
    for (bool straight = true; straight;) {
      SurfacePoint point;
      if (!way.next(point)) return glow(stop, static_cast<const SurfacePoint*>(nullptr));
      glow(stop, static_cast<const SurfacePoint*>(&point));
      const Bsdf bsdf = way.bsdf(point);
      if (bsdf.scatters()) scatter(stop, point, bsdf);
      if (!bsdf.has_specular() && !bsdf.passes_straight()) return;
      BsdfSample next;
      const float u_lobe = random.uniform();
      if (!bsdf.sample(-stop.direction, u_lobe, random.uniform2(), next) || !next.specular) return;
      stop.throughput *= next.weight, stop.passed = true;
      if (!survives(++events, max_component(stop.throughput), random, stop.throughput)) return;
      straight = next.straight;
      if (!straight) ray = {point.leave(next.direction), next.direction, 0, kInfinity};
    }
  }
}

}  // namespace phos::inline reference
