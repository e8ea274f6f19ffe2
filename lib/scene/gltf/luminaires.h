// EXT_lights_ies: measured luminaires of glTF.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "scene/gltf/document.h"
#include "scene/luminaire/photometric_file.h"

namespace phos::inline scene {

/// Throws Error(bad_input) for members of the wrong kind or out of range. (A step of check_gltf.)
void check_gltf_luminaires(const Json& document, const std::string& path);

/// What a node says of a luminaire.
struct GltfLuminaire {
  std::size_t profile = 0;  ///< of EXT_lights_ies.lights
  std::string name;         ///< of the profile; may be empty
  Rgb colour{1};            ///< colour and multiplier
};
std::optional<GltfLuminaire> gltf_luminaire(const Json& document, std::size_t node);

/// The profiles of a document, each read once.
class GltfProfiles {
 public:
  explicit GltfProfiles(const GltfDocument& document) : document_(document) {}
  std::shared_ptr<const PhotometricFile> read(std::size_t profile);

 private:
  const GltfDocument& document_;
  std::map<std::size_t, std::shared_ptr<const PhotometricFile>> file_;
};

}  // namespace phos::inline scene
