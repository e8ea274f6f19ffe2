#include "estimate/zone/tangent_surface.h"

#include <algorithm>
#include <cmath>

namespace phos::inline estimate {

float slab_m(const ZonePlace& place, float radius_m) {
  return std::max(kSlab * radius_m, 4 * place.rounding_m);
}

void TangentSurface::limit_slab(ZonePlace& place, float radius_m) const {
  const float slab = slab_m(place, radius_m);
  const auto half_way = [&](const Vec3& direction) {
    Hit hit;
    const Ray ray{place.p, direction, std::max(4 * place.rounding_m, 0.02f * slab), slab};
    return slab > 4 * place.rounding_m && rays_.intersect(ray, hit) ? hit.distance_m / 2 : slab;
  };
  place.above_m = half_way(place.frame.z), place.below_m = half_way(-place.frame.z);
}

bool TangentSurface::within_sight(const ZonePlace& place, const Vec2& offset_m, float height_m) const {
  const Vec3 up = place.above_m * place.frame.z;
  const Vec3 to = place.frame.to_world(Vec3(offset_m, height_m));
  const float distance = glm::length(to);
  return !(distance > 0) || !rays_.occluded({place.p + up, to / distance, 0, distance});
}

bool TangentSurface::on_surface(ZonePlace& place, const Vec2& offset_m) const {
  const Vec3 from = place.p + place.frame.to_world(Vec3(offset_m, place.above_m));
  const Ray ray{from, -place.frame.z, 0, place.above_m + place.below_m};
  Hit hit;
  if (!rays_.intersect(ray, hit)) return false;
  if (!(glm::dot(rays_.surface(ray, hit).smooth_normal, place.frame.z) > kSameFacing)) return false;
  if (within_sight(place, offset_m, place.above_m - hit.distance_m)) return true;
  place.parted = true;
  return false;
}

}  // namespace phos::inline estimate
