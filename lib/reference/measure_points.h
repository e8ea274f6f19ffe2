// Irradiance at points by the method that a scene asks for, with the light that the errors do not hold.
#pragma once

#include <span>
#include <vector>

#include "reference/method.h"
#include "reference/point_doubts.h"
#include "reference/point_irradiance.h"

namespace phos::inline reference {

struct MeasuredPoints {
  std::vector<PointIrradiance> light;       ///< of each point, in order
  PointDoubts doubts;                       ///< to be told
  std::uint64_t samples = 0, rejected = 0;  ///< of all points; rejected: not finite, left out
};

/// `ways` of the scene by which light can reach the points (light_ways()): they decide the meaning of
/// `automatic` and which errors are doubted. Point i has the random numbers of item options.item + i. Shows
/// progress. Same bytes for any number of threads.
MeasuredPoints measure_points(const RayScene& rays, const Luminaires& luminaires,
                              std::span<const SensorPoint> points, ReferenceMethod method,
                              const std::vector<LightWay>& ways, PointOptions options);

}  // namespace phos::inline reference
