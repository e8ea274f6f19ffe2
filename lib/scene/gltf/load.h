#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scene/load.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// Reads a .glb or .gltf, at the time the options ask for. Not finalized. Throws Error(bad_input),
/// Error(usage) for a time and a frame together.
Scene load_gltf(const std::string& path, std::string_view bytes, const SceneOptions& options);

}  // namespace phos::inline scene
