// Tracing photons from the lights through the scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/counters.h"
#include "core/options.h"
#include "file/shards.h"
#include "photon/photon_map.h"
#include "scene/rays.h"

namespace phos::inline photon {

struct PhotonOptions {
  std::int64_t paths = 1'000'000;  ///< emitted from the lights
  /// Paths aimed from the lamps at mirrors and glass, which then find all caustic light; below 0: as many as
  /// `paths`; 0: none, and caustic light is the caustic light of other paths.
  std::int64_t caustic_paths = -1;
  double minimum_share = 0.1;  ///< of an equal share of the paths, for each light
  std::string isa;             ///< RayOptions::isa
  std::string shard;           ///< "i/n", or empty: all
};
void declare_options(Options& options, PhotonOptions& photons);

/// Numbers of the paths that a shard "i/n" of `paths` traces (all if empty). Throws Error(usage) unless
/// 1 <= i <= n.
ItemRange path_range(const std::string& shard, std::int64_t paths);

/// Photons of the paths that options.shard names, in path order (each with the aimed paths that follow it):
/// one at each hit on a surface that is not purely specular (black and glowing ones too), carrying the flux
/// that arrives. A path ends when it escapes or by Russian roulette, which keeps the flux of the survivors
/// about equal; there is no other limit but kTooLongEvent. Throws Error(numerical) once that happens
/// to more than one path in a hundred. Unbiased: the expected flux stored on a piece of surface is its
/// irradiance, all bounces, times its area. The same for any number of threads and any shards. Throws
/// Error(bad_input) if nothing shines, unless there are no paths. `log`, if given, gets every ray that was
/// traced.
Photons trace_photons(const RayScene& rays, const PhotonOptions& options, std::uint64_t seed,
                      PhotonTotals& totals, Counters& counters, std::vector<Ray>* log = nullptr);

}  // namespace phos::inline photon
