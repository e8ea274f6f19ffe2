// Photons traced and records made in memory.
#pragma once

#include <memory>

#include "cache/placement.h"
#include "photon/trace.h"
#include "support/golden_table.h"
#include "support/scenes.h"

namespace phos::test {

/// A scene with its photons.
struct Lit {
  std::unique_ptr<Scene> scene;
  std::unique_ptr<RayScene> rays;
  PhotonMap photons;
};

inline Lit light_up(const Scene& scene, std::int64_t paths, std::uint64_t seed = 1) {
  auto own = std::make_unique<Scene>(scene);
  auto rays = std::make_unique<RayScene>(*own);
  PhotonTotals totals;
  Counters counters;
  PhotonOptions options;
  options.paths = paths;
  Photons photons = trace_photons(*rays, options, seed, totals, counters);
  return {std::move(own), std::move(rays), PhotonMap::build(std::move(photons), totals)};
}

inline RecordOptions all_light(const Scene& scene) {
  RecordOptions options;
  options.paths = Quantity::all;
  options.resolve(scene.bounds.diagonal_m());
  return options;
}

inline IrradianceRecord record_at(const RecordMaker& maker, const Vec3& p, const Vec3& n,
                                  std::uint64_t item = 0) {
  RecordMaker::Scratch scratch;
  return maker.make(p, n, item, RecordMaker::kNoPhoton, scratch).record;
}

}  // namespace phos::test
