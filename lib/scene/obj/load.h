#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/load.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// Reads a Wavefront .obj with its .mtl, and lights and cameras from <name>.lights.json beside it
/// (scene/obj/lights.h). Not finalized. Throws Error(bad_input).
Scene load_obj(const std::string& path, std::string_view bytes, const SceneOptions& options);

/// Files that an .obj may read, whether they exist or not: its mtllib and their textures, and
/// <name>.lights.json.
std::vector<std::string> obj_external_files(const std::string& path, std::string_view bytes);

}  // namespace phos::inline scene
