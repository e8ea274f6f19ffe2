#include "reference/map/foot.h"

#include "scene/material/bsdf.h"

namespace phos::inline reference {

std::optional<SurfacePoint> foot_of(const RayScene& rays, const SensorPoint& sensor, const MapLight& light) {
  constexpr float kFacing = 0.999f, kOff = 0.1f;
  const SurfacePoint at = sensor_at(rays.scene(), sensor.position, sensor.normal);
  SurfacePoint foot;
  if (!trace(rays, {at.leave(sensor.normal), -sensor.normal, 0, kInfinity}, foot)) return std::nullopt;
  const float radius_m = light.disc_radius_m(foot.position).value_or(kInfinity);
  const bool near = foot.distance_m - 2 * at.error_m <= kOff * radius_m;
  const bool facing = glm::dot(foot.geometric_normal, sensor.normal) >= kFacing;
  if (!near || !facing || !Bsdf(rays.scene(), foot).takes_light()) return std::nullopt;
  return foot;
}

}  // namespace phos::inline reference
