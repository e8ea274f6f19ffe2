#include "scene/spectral/band_spectra.h"

#include <set>

#include "core/error.h"
#include "core/text/named_files.h"
#include "scene/material/models.h"

namespace phos::inline scene {
namespace {

constexpr const char* kEnvironment = "environment";

/// Lights and luminaires; nodes that shine by their materials; materials.
std::set<std::string> light_names(const Scene& scene) {
  std::set<std::string> names;
  for (const Light& light : scene.light) names.insert(light.name);
  for (const Instance& instance : scene.instance)
    if (instance.fitting >= 0) names.insert(instance.node);
  return names;
}

/// Now, or at another time of its animation.
bool shines(const Scene& scene, std::size_t material) {
  if (scene.material[material].emits()) return true;
  for (const Animation& animation : scene.animation)
    for (const std::string& target : animation.targets)
      for (const char* member : {"/emissiveFactor", "/extensions/KHR_materials_emissive_strength/"})
        if (target.starts_with(text("/materials/", material, member))) return true;
  return false;
}

std::set<std::size_t> shining_materials(const Scene& scene, const std::string& node) {
  std::set<std::size_t> materials;
  for (const Instance& i : scene.instance)
    if (i.node == node && i.fitting < 0 && shines(scene, i.material)) materials.insert(i.material);
  return materials;
}

std::set<std::size_t> materials_named(const Scene& scene, const std::string& name) {
  std::set<std::size_t> materials;
  for (std::size_t i = 0; i < scene.material.size(); ++i)
    if (scene.material[i].name == name) materials.insert(i);
  return materials;
}

std::string all_names(const Scene& scene) {
  std::set<std::string> names = light_names(scene);
  for (const Material& m : scene.material) names.insert(m.name);
  if (scene.environment) names.insert(kEnvironment);
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "\"" : ", \"") + name + "\"";
  return out;
}

[[noreturn]] void wrong_name(const std::string& name, const std::string& what) {
  throw Error(ExitCode::usage, "--spectrum", text("\"", name, "\" ", what));
}

}  // namespace

BandSpectra::BandSpectra(const Scene& scene, const BandOptions& options) {
  for (std::size_t i = 0; i < scene.material.size(); ++i)
    if (const std::string& file = scene.material[i].spectrum; !file.empty()) give_material(scene, i, file);
  for (const auto& [name, file] : scene.light_spectrum) light_[name] = read(file, SpectrumKind::power);
  std::set<std::string> given;
  for (const NamedFile& w : named_files(options.spectra, "--spectrum")) {
    if (!given.insert(w.name).second) wrong_name(w.name, "is given twice");
    give(scene, w.name, w.file);
  }
  require_overlap();
}

const Spectrum* BandSpectra::read(const std::string& file, SpectrumKind kind) {
  auto& spectrum = (kind == SpectrumKind::power ? powers_ : reflectances_)[file];
  if (!spectrum) spectrum = std::make_unique<const Spectrum>(read_spectrum(file, kind));
  return spectrum.get();
}

void BandSpectra::give(const Scene& scene, const std::string& name, const std::string& file) {
  const bool light = light_names(scene).count(name) > 0;
  const std::set<std::size_t> named = materials_named(scene, name), shining = shining_materials(scene, name);
  if (light && !named.empty())
    wrong_name(name, "is both a light and a material of the scene; give one of them another name");
  if (light) {
    light_[name] = read(file, SpectrumKind::power);
  } else if (!named.empty()) {
    for (const std::size_t i : named) give_material(scene, i, file);
  } else if (!shining.empty()) {
    for (const std::size_t i : shining) give_material(scene, i, file);
  } else if (name == kEnvironment && scene.environment) {
    environment_ = read(file, SpectrumKind::power);
  } else {
    wrong_name(name, "is no light or material; the scene has " + all_names(scene));
  }
}

void BandSpectra::give_material(const Scene& scene, std::size_t i, const std::string& file) {
  const Material& material = scene.material[i];
  if (shines(scene, i)) {
    emission_[i] = read(file, SpectrumKind::power);
  } else if (const char* is = row_of(material).no_spectrum; !is) {
    reflectance_[i] = read(file, SpectrumKind::reflectance);
  } else {
    throw Error(ExitCode::usage, scene.path,
                text("material \"", material.name, "\" is ", is,
                     ", which has no reflectance that a spectrum could give; leave its spectrum out"));
  }
}

/// A paint that was measured where a lamp does not shine at all says nothing about how it looks there.
void BandSpectra::require_overlap() const {
  for (const auto& [paint_file, paint] : reflectances_) {
    const double lo_nm = paint->wavelengths_nm().front(), hi_nm = paint->wavelengths_nm().back();
    for (const auto& [lamp_file, lamp] : powers_) {
      const Spectrum::Range light = lamp->above_zero_nm();
      if (light.lo_nm < hi_nm && lo_nm < light.hi_nm) continue;
      throw Error(ExitCode::bad_input, paint_file,
                  text("its data, ", shortest(lo_nm), " to ", shortest(hi_nm),
                       " nm, hold nothing of the light of ", lamp_file, ", ", shortest(light.lo_nm), " to ",
                       shortest(light.hi_nm), " nm; give a spectrum that overlaps"));
    }
  }
}

}  // namespace phos::inline scene
