// The files that records are made from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cache/brdf_table.h"
#include "cache/irradiance_cache.h"
#include "cache/record_options.h"
#include "photon/photon_map.h"
#include "scene/scene.h"

namespace phos {

/// Scene, photons, cache and lobes among inputs given in any order; all but the scene may be absent ("").
struct IrradianceFiles {
  std::string scene, photons, source, brdf;
};
/// Tells them apart by their contents. Throws Error(usage) for none or two of a kind, or another kind;
/// Error(bad_input) for a file that cannot be read.
IrradianceFiles sort_inputs(const std::vector<std::string>& paths);

/// What an estimate may read, besides the scene.
struct EstimateInputs {
  std::optional<PhotonMap> photons;
  std::optional<IrradianceCache> source;  ///< read by rays where they land, in place of a coarse cache
  std::vector<BrdfTable> brdf;            ///< lobes of glossy materials
};
/// Throws Error(mismatch) for files of another scene, unless `allow_mismatch`.
EstimateInputs open_inputs(const IrradianceFiles& files, const Scene& scene, bool allow_mismatch);

/// A file to add to. Throws Error(mismatch) if it was made from another scene, or from other photons than
/// those given, unless `allow_mismatch`.
Container open_to_add(const std::string& path, const std::string& kind, const IrradianceFiles& files,
                      const Scene& scene, bool allow_mismatch);

/// The cache to add to. Options that were not given become its own; one that was and differs throws
/// Error(mismatch), as open_to_add() does.
IrradianceCache open_earlier(const std::string& path, const IrradianceFiles& files, const Scene& scene,
                             bool allow_mismatch, const Options& given, RecordOptions& records);

}  // namespace phos
