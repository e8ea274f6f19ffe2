#include "estimate/next_surface.h"

namespace phos::inline estimate {

float height_over_next_m(const RayScene& rays, const Vec3& p, const Vec3& n, float least_m, float radius_m) {
  Hit hit;
  const Ray ray{p, -n, least_m, kNextSurface * radius_m};
  return ray.t_max_m > ray.t_min_m && rays.intersect(ray, hit) ? hit.distance_m : kInfinity;
}

}  // namespace phos::inline estimate
