// What records are made from, opened.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimate/record_options.h"
#include "photon/photon_map.h"
#include "radiance/brdf/table.h"
#include "radiance/cache.h"
#include "record/irradiance_cache.h"
#include "stage/inputs.h"

namespace phos::stage {

/// What an estimate may read, besides the scene.
struct RecordInputs {
  std::optional<PhotonMap> photons;
  /// Records that rays read where they land, in place of a coarse cache, with the irradiance of radiance
  /// records.
  std::optional<IrradianceCache> source;
  std::optional<RadianceCache> radiance;  ///< read by rays where they land on gloss
  std::vector<BrdfTable> brdf;            ///< lobes of glossy materials
};
/// Throws Error(mismatch) for files of another scene, unless `allow_mismatch`.
RecordInputs open_record_inputs(const RecordFiles& files, const Scene& scene, bool allow_mismatch);

/// Caustic photons that are to travel with records made from these inputs, which then leave such light out
/// (RecordOptions::caustics_apart): the photons of the cache that is added to, or of the photon map, or of a
/// cache that is read. Null: records hold the caustic light that they find. That is so without photons, where
/// lamps without area and the sun are not found by way of mirrors; and where nothing in the scene is a mirror
/// or glass. Throws Error(mismatch) for an earlier cache whose records hold such light, and photons that
/// would not.
std::shared_ptr<const CausticPhotons> caustics_of_run(const RecordInputs& inputs, const Scene& scene,
                                                      const IrradianceCache* earlier_or_null,
                                                      const std::string& earlier_path);

/// Lets radiance records cover places that an irradiance cache need not cover again.
class CoveredBy {
 public:
  /// Appends their irradiance to the cache, if the cache holds indirect light as they do.
  CoveredBy(IrradianceCache& cache, const std::optional<RadianceCache>& radiance);
  /// Once others have been appended: leaves those in alone.
  void take_out(IrradianceCache& cache) const;

 private:
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace phos::stage
