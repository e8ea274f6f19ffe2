// The place of a surface that a sensor lies on.
#pragma once

#include <optional>

#include "reference/map/map_light.h"
#include "reference/point_irradiance.h"

namespace phos::inline reference {

/// Where photons tell of a sensor: the surface at most a tenth of the radius of their disc behind it, facing
/// as it does to within 2.5 degrees, and no mirror or glass, on which no photon is stored. Null: there is
/// none.
std::optional<SurfacePoint> foot_of(const RayScene& rays, const SensorPoint& sensor, const MapLight& light);

}  // namespace phos::inline reference
