#include "stage/record_inputs.h"

#include "core/error.h"
#include "photon/caustic_map.h"
#include "radiance/brdf/file.h"
#include "scene/material/sharp_materials.h"
#include "temporal/film/inputs.h"

namespace phos::stage {

RecordInputs open_record_inputs(const RecordFiles& files, const Scene& scene, bool allow_mismatch) {
  const auto open = [&](const std::string& path, FileKind kind) {
    Container file = Container::open(path, kind);
    require_together(file, files.scene, scene, allow_mismatch);
    return file;
  };
  RecordInputs inputs;
  if (!files.photons.empty()) {
    inputs.photons = PhotonMap::open(files.photons);
    require_together(*inputs.photons->container(), files.scene, scene, allow_mismatch);
  }
  if (!files.source.empty())
    inputs.source = read_irradiance_at(open(files.source, FileKind::irradiance), scene);
  if (!files.radiance.empty()) {
    inputs.radiance = read_radiance_at(open(files.radiance, FileKind::radiance), scene);
    if (inputs.source && inputs.source->quantity == Quantity::indirect) {
      require_same_caustics(inputs.radiance->caustics != nullptr, inputs.source->caustics != nullptr,
                            files.radiance);
      append(*inputs.source, irradiance_of(*inputs.radiance));
    }
  }
  if (!files.brdf.empty()) inputs.brdf = read_brdf(open(files.brdf, FileKind::brdf));
  return inputs;
}

std::shared_ptr<const CausticPhotons> caustics_of_run(const RecordInputs& inputs, const Scene& scene,
                                                      const IrradianceCache* earlier,
                                                      const std::string& earlier_path) {
  if (earlier && earlier->caustics) return earlier->caustics;
  std::shared_ptr<const CausticPhotons> caustics;
  if (inputs.photons && (casts_caustics(scene) || inputs.photons->has_caustics()))
    caustics = std::make_shared<CausticPhotons>(caustics_of(*inputs.photons));
  else if (inputs.source)
    caustics = inputs.source->caustics;
  if (earlier && !earlier->records.empty()) require_same_caustics(false, caustics != nullptr, earlier_path);
  return caustics;
}

CoveredBy::CoveredBy(IrradianceCache& cache, const std::optional<RadianceCache>& radiance)
    : first_(cache.records.size()) {
  if (!radiance || cache.quantity != Quantity::indirect) return;
  require_same_caustics(radiance->caustics != nullptr, cache.caustics != nullptr, "the radiance cache");
  append(cache, irradiance_of(*radiance));
  count_ = radiance->records.size();
}

void CoveredBy::take_out(IrradianceCache& cache) const {
  const auto first = cache.records.begin() + static_cast<std::ptrdiff_t>(first_);
  cache.records.erase(first, first + static_cast<std::ptrdiff_t>(count_));
}

}  // namespace phos::stage
