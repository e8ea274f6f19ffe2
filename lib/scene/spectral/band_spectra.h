// The spectra that belong to materials and lights of a scene.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/spectral/band_options.h"
#include "scene/spectral/spectrum.h"

namespace phos::inline scene {

/// As options (--spectrum) and the scene itself (extras.phos.spectrum) say; options come first. Each file is
/// read once. Throws as to_bands().
class BandSpectra {
 public:
  BandSpectra(const Scene& scene, const BandOptions& options);
  // Null: it has none.
  const Spectrum* of_light(const std::string& name) const { return find(light_, name); }
  const Spectrum* of_reflectance(std::size_t material) const { return find(reflectance_, material); }
  const Spectrum* of_emission(std::size_t material) const { return find(emission_, material); }
  const Spectrum* of_environment() const { return environment_; }

 private:
  template <class Key>
  static const Spectrum* find(const std::map<Key, const Spectrum*>& map, const Key& key) {
    const auto it = map.find(key);
    return it == map.end() ? nullptr : it->second;
  }
  const Spectrum* read(const std::string& file, SpectrumKind kind);
  void give(const Scene& scene, const std::string& name, const std::string& file);
  void give_material(const Scene& scene, std::size_t material, const std::string& file);
  void require_overlap() const;

  std::map<std::string, std::unique_ptr<const Spectrum>> reflectances_, powers_;  // by file
  std::map<std::string, const Spectrum*> light_;
  std::map<std::size_t, const Spectrum*> reflectance_, emission_;
  const Spectrum* environment_ = nullptr;
};

}  // namespace phos::inline scene
