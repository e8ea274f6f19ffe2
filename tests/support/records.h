// Photons traced and records made in memory.
#pragma once

#include <memory>

#include "estimate/density.h"
#include "photon/trace.h"
#include "place/placement.h"
#include "place/placement_options.h"
#include "scene/rays.h"
#include "support/golden_table.h"
#include "support/scenes.h"

namespace phos::test {

/// A scene with its photons.
struct Lit {
  std::unique_ptr<Scene> scene;
  std::unique_ptr<RayScene> rays;
  PhotonMap photons;
};

inline PhotonMap photons_of(const RayScene& rays, std::int64_t paths, std::uint64_t seed) {
  PhotonTotals totals;
  Counters counters;
  PhotonOptions options;
  options.paths = paths;
  Photons photons = trace_photons(rays, options, seed, totals, counters);
  return PhotonMap::build(std::move(photons), totals);
}

inline Lit light_up(const Scene& scene, std::int64_t paths, std::uint64_t seed = 1) {
  auto own = std::make_unique<Scene>(scene);
  auto rays = std::make_unique<RayScene>(*own);
  PhotonMap photons = photons_of(*rays, paths, seed);
  return {std::move(own), std::move(rays), std::move(photons)};
}

inline RecordOptions all_light(const Scene& scene) {
  RecordOptions options;
  options.paths = Quantity::all;
  options.resolve(scene.bounds.diagonal_m() / 4);
  return options;
}

inline IrradianceRecord record_at(const Estimator& estimator, const Vec3& p, const Vec3& n,
                                  std::uint64_t item = 0) {
  const auto worker = estimator.make_worker();
  return estimator.make({p, n, item}, *worker).record;
}

/// From photons, where photons are.
inline PlacementReport place_at_photons(IrradianceCache& cache, const PhotonMap& photons,
                                        const RayScene& rays, const RecordOptions& resolved,
                                        const PlacementOptions& placement, std::uint64_t seed,
                                        Counters& counters) {
  const DensityEstimator maker(photons, rays, resolved, seed);
  return place_records(cache, maker, rays, resolved, placement,
                       photon_candidates(photons, resolved.paths, seed, placement.max_candidates), counters);
}

/// From photons, at given points.
inline PlacementReport place_at_points(IrradianceCache& cache, const PhotonMap& photons, const RayScene& rays,
                                       const RecordOptions& resolved, const PlacementOptions& placement,
                                       std::uint64_t seed, std::span<const SurfaceSample> points,
                                       Counters& counters) {
  const DensityEstimator maker(photons, rays, resolved, seed);
  return place_records(cache, maker, rays, resolved, placement, point_candidates(points), counters);
}

}  // namespace phos::test
