// Irradiance at points by a method that reads a photon map.
#pragma once

#include <span>
#include <string>

#include "reference/map/map_light.h"
#include "reference/measure_points.h"

namespace phos::inline reference {

/// As estimate_irradiance() with samples of MapLight::irradiance(), one of them where they do not differ;
/// their noise is part of the standard error. Point i has the random numbers of item options.item + i. Where
/// photons of the point itself are read it is put on the surface that it lies on (foot_of()); throws
/// Error(bad_input) for one that lies on none, with its number in `where`. Shows progress. Same bytes for any
/// number of threads.
MeasuredPoints measure_map_points(const MapLight& light, const RayScene& rays, bool lit,
                                  std::span<const SensorPoint> points, const std::string& where,
                                  PointOptions options);

}  // namespace phos::inline reference
