// The files that records are made from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cache/irradiance_cache.h"
#include "cache/record_options.h"
#include "photon/photon_map.h"
#include "scene/scene.h"

namespace phos {

/// Scene, photons and cache among inputs given in any order; the latter two may be absent ("").
struct IrradianceFiles {
  std::string scene, photons, source;
};
/// Tells them apart by their contents. Throws Error(usage) for none or two of a kind, or another kind;
/// Error(bad_input) for a file that cannot be read.
IrradianceFiles sort_inputs(const std::vector<std::string>& paths);

/// What an estimate may read, besides the scene.
struct EstimateInputs {
  std::optional<PhotonMap> photons;
  std::optional<IrradianceCache> source;  ///< read by rays where they land, in place of a coarse cache
};
/// Throws Error(mismatch) for files of another scene, unless `allow_mismatch`.
EstimateInputs open_inputs(const IrradianceFiles& files, const Scene& scene, bool allow_mismatch);

/// The cache to add to. Options that were not given become its own; one that was and differs throws
/// Error(mismatch), as do other photons than those that it was made from, unless `allow_mismatch`.
IrradianceCache open_earlier(const std::string& path, const IrradianceFiles& files, const Scene& scene,
                             bool allow_mismatch, const Options& given, RecordOptions& records);

}  // namespace phos
