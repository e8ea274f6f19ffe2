// What a glTF file says and phos does not model, found by walking through it.
#pragma once

#include <vector>

#include "core/json.h"
#include "scene/note.h"

namespace phos::inline scene {

/// Notes on extensions, listed or used, and on properties that are not modelled or modelled in part
/// (scene/report/features.h), with the material, node or other object that each is of. Of the checked
/// document (check_gltf).
std::vector<Note> gltf_findings(const Json& document);

/// Notes on materials that state neither metallicFactor nor a metallicRoughnessTexture, so that glTF makes
/// them metals, and are likely meant as paint: their base colour is not black, their names are not of metals
/// or mirrors, and the file is not of an exporter that leaves the value out where it is 1.
std::vector<Note> metals_by_default(const Json& document);

}  // namespace phos::inline scene
