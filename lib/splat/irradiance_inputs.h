// The files that records are made from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "estimate/record_options.h"
#include "file/tool.h"
#include "photon/photon_map.h"
#include "radiance/brdf/table.h"
#include "radiance/cache.h"
#include "record/irradiance_cache.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace phos {

/// Scene, photons, caches and lobes among inputs given in any order; all but the scene may be absent ("").
struct IrradianceFiles {
  std::string scene, photons, source, radiance, brdf;
};
/// Tells them apart by their contents. Throws Error(usage) for none or two of a kind, or another kind;
/// Error(bad_input) for a file that cannot be read.
IrradianceFiles sort_inputs(const std::vector<std::string>& paths);

/// Enters them in the tool's provenance, each under its role.
void add_inputs(Tool& tool, const IrradianceFiles& files, const SceneOptions& scene_options);

/// What an estimate may read, besides the scene.
struct EstimateInputs {
  std::optional<PhotonMap> photons;
  /// Read by rays where they land, in place of a coarse cache; what radiance records say among it.
  std::optional<IrradianceCache> source;
  std::optional<RadianceCache> radiance;  ///< read by rays where they land on gloss
  std::vector<BrdfTable> brdf;            ///< lobes of glossy materials
};
/// Throws Error(mismatch) for files of another scene, unless `allow_mismatch`.
EstimateInputs open_inputs(const IrradianceFiles& files, const Scene& scene, bool allow_mismatch);

/// Caustic photons that are to travel with records made from these inputs, which then leave such light out
/// (RecordOptions::caustics_apart): those of the cache that is added to, or of the photons, or of a cache
/// that is read. Null: records hold what they find of it. That is so without photons, where lamps without
/// area and the sun are not found by way of mirrors; and where nothing in the scene is a mirror or glass.
/// Throws Error(mismatch) for an earlier cache whose records hold such light, and photons that would not.
std::shared_ptr<const CausticPhotons> caustics_of_run(const EstimateInputs& inputs, const Scene& scene,
                                                      const IrradianceCache* earlier_or_null,
                                                      const std::string& earlier_path);

/// Lets radiance records cover what an irradiance cache need not hold again.
class CoveredBy {
 public:
  /// Appends what they say of irradiance to the cache, if that holds indirect light as they do.
  CoveredBy(IrradianceCache& cache, const std::optional<RadianceCache>& radiance);
  /// Once others have been appended: leaves those in alone.
  void take_out(IrradianceCache& cache) const;

 private:
  std::size_t first_ = 0, count_ = 0;
};

/// A file to add to. Throws Error(mismatch) if it was made from another scene, or from other photons than
/// those given, unless `allow_mismatch`.
Container open_to_add(const std::string& path, const std::string& kind, const IrradianceFiles& files,
                      const Scene& scene, bool allow_mismatch);

/// The cache to add to. Options that were not given become its own; one that was and differs throws
/// Error(mismatch), as open_to_add() does.
IrradianceCache open_earlier(const std::string& path, const IrradianceFiles& files, const Scene& scene,
                             bool allow_mismatch, const Options& given, RecordOptions& records);

}  // namespace phos
