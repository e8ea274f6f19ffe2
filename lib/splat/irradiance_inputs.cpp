#include "splat/irradiance_inputs.h"

#include "core/error.h"
#include "file/hash.h"
#include "file/mapped_file.h"
#include "scene/material/sharp_materials.h"
#include "temporal/film/inputs.h"

namespace phos {
namespace {

void take(std::string& slot, const std::string& path, const char* what) {
  if (!slot.empty())
    throw Error(ExitCode::usage, path, text("is a second ", what, " beside ", slot, "; give one"));
  slot = path;
}

}  // namespace

IrradianceFiles sort_inputs(const std::vector<std::string>& paths) {
  IrradianceFiles files;
  for (const std::string& path : paths) {
    if (!is_container(path)) {
      hash_file(path);  // a missing file is said to be missing
      require_bytes(path);
      take(files.scene, path, "scene");
      continue;
    }
    const std::string kind = Container::open(path).provenance().kind;
    if (kind == "photons")
      take(files.photons, path, "photon map");
    else if (kind == "irradiance")
      take(files.source, path, "irradiance cache");
    else if (kind == "radiance")
      take(files.radiance, path, "radiance cache");
    else if (kind == "brdf")
      take(files.brdf, path, "file of lobes");
    else
      throw Error(
          ExitCode::usage, path,
          text("holds ", kind, "; give a scene, photons, its .brdf file, or a cache for rays to read"));
  }
  if (files.scene.empty())
    throw Error(ExitCode::usage, "", "no scene among the inputs; give the .glb, .gltf or .obj too");
  return files;
}

void add_inputs(Tool& tool, const IrradianceFiles& files, const SceneOptions& scene_options) {
  tool.add_input("scene", scene_files(files.scene, scene_options));
  if (!files.photons.empty()) tool.add_input("photons", files.photons);
  if (!files.source.empty()) tool.add_input("source", files.source);
  if (!files.radiance.empty()) tool.add_input("gloss", files.radiance);
  if (!files.brdf.empty()) tool.add_input("brdf", files.brdf);
}

EstimateInputs open_inputs(const IrradianceFiles& files, const Scene& scene, bool allow_mismatch) {
  EstimateInputs inputs;
  if (!files.photons.empty()) {
    inputs.photons = PhotonMap::open(files.photons);
    if (!allow_mismatch)
      require_same_scene(*inputs.photons->container(), files.scene, scene.hash, scene.parts);
  }
  if (!files.source.empty()) {
    const Container file = Container::open(files.source, "irradiance");
    if (!allow_mismatch) require_same_scene(file, files.scene, scene);
    inputs.source = read_irradiance_at(file, scene);
  }
  if (!files.radiance.empty()) {
    const Container file = Container::open(files.radiance, "radiance");
    if (!allow_mismatch) require_same_scene(file, files.scene, scene);
    inputs.radiance = read_radiance_at(file, scene);
    if (inputs.source && inputs.source->quantity == "indirect") {
      require_same_caustics(inputs.radiance->caustics != nullptr, inputs.source->caustics != nullptr,
                            files.radiance);
      append(*inputs.source, irradiance_of(*inputs.radiance));
    }
  }
  if (!files.brdf.empty()) {
    const Container file = Container::open(files.brdf, "brdf");
    if (!allow_mismatch) require_same_scene(file, files.scene, scene.hash, scene.parts);
    inputs.brdf = read_brdf(file);
  }
  return inputs;
}

std::shared_ptr<const CausticPhotons> caustics_of_run(const EstimateInputs& inputs, const Scene& scene,
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
  if (!radiance || cache.quantity != "indirect") return;
  require_same_caustics(radiance->caustics != nullptr, cache.caustics != nullptr, "the radiance cache");
  append(cache, irradiance_of(*radiance));
  count_ = radiance->records.size();
}

void CoveredBy::take_out(IrradianceCache& cache) const {
  const auto first = cache.records.begin() + static_cast<std::ptrdiff_t>(first_);
  cache.records.erase(first, first + static_cast<std::ptrdiff_t>(count_));
}

Container open_to_add(const std::string& path, const std::string& kind, const IrradianceFiles& files,
                      const Scene& scene, bool allow_mismatch) {
  Container file = Container::open(path, kind);
  if (is_film(file))
    throw Error(ExitCode::usage, path,
                "is a film, and records are added to a cache of one scene; give one as --add-to, or both "
                "files to phos-splat");
  if (!allow_mismatch) {
    require_same_scene(file, files.scene, scene.hash, scene.parts);
    const auto& inputs = file.provenance().inputs;
    const auto photons = inputs.find("photons");
    if (photons != inputs.end() && !files.photons.empty() &&
        photons->second != hash_file(files.photons).hex()) {
      throw Error(ExitCode::mismatch, path,
                  "was made from other photons; give those, or pass --allow-mismatch to mix the two");
    }
  }
  return file;
}

IrradianceCache open_earlier(const std::string& path, const IrradianceFiles& files, const Scene& scene,
                             bool allow_mismatch, const Options& given, RecordOptions& records) {
  const Container file = open_to_add(path, "irradiance", files, scene, allow_mismatch);
  adopt_options(records, given, file);
  return read_irradiance(file);
}

}  // namespace phos
