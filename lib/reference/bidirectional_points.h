// Irradiance at points along paths from both ends, with its standard error.
#pragma once

#include <span>

#include "reference/point_irradiance.h"

namespace phos::inline reference {

/// Irradiance of many sensors, which share light paths; as estimate_irradiance() else. At least 16 passes of
/// as many independent light paths tell the standard error. Light that comes to a sensor by way of mirrors,
/// glass and sharp gloss alone is that through a disc about it, within the largest radius at which it is that
/// of all smaller ones but for noise (DiscLight): the more paths, the smaller. The estimated bias of discs
/// and of merging is part of the standard error. With `relative_error`, sensors whose error is small enough
/// after 16, 32, 64, ... passes are done. PointOptions::item: of the first sensor. Same bytes for any number
/// of threads.
std::vector<PointIrradiance> estimate_bidirectionally(const RayScene& rays, const Luminaires& luminaires,
                                                      std::span<const SensorPoint> sensors,
                                                      const PointOptions& options);

}  // namespace phos::inline reference
