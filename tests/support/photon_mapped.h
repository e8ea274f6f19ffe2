// Methods of the reference that read a photon map, over a scene.
#pragma once

#include <memory>
#include <vector>

#include "photon/trace.h"
#include "reference/map/map_points.h"
#include "reference/method.h"
#include "support/reference.h"

namespace phos::test {

inline PhotonMap traced_map(const RayScene& rays, std::int64_t paths, std::uint64_t seed = 1) {
  PhotonOptions options;
  options.paths = paths;
  PhotonTotals totals;
  Counters counters;
  Photons photons = trace_photons(rays, options, seed, totals, counters);
  return PhotonMap::build(std::move(photons), totals);
}

struct PhotonMapped : RaysAndLamps {
  PhotonMapped(const Scene& scene, std::int64_t paths)
      : RaysAndLamps(scene), photons(traced_map(rays, paths)) {}

  std::unique_ptr<MapLight> light(ReferenceMethod method, const MapOptions& options) const {
    return row_of(method).map_light({rays, luminaires, photons}, options);
  }
  std::vector<PointIrradiance> measure(ReferenceMethod method, const std::vector<SensorPoint>& points,
                                       std::int64_t samples, const MapOptions& options) const {
    PointOptions point_options;
    point_options.samples = samples;
    return measure_map_points(*light(method, options), rays, luminaires.size() > 0, points, "points",
                              point_options)
        .light;
  }

  PhotonMap photons;
};

inline std::vector<SensorPoint> sensors_at(const std::vector<Check>& checks) {
  std::vector<SensorPoint> sensors;
  for (const Check& check : checks) sensors.push_back({check.position, check.normal});
  return sensors;
}

}  // namespace phos::test
