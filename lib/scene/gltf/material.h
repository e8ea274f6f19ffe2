#pragma once

#include "scene/gltf/document.h"
#include "scene/scene.h"
#include "scene/texture/load_textures.h"

namespace phos::inline scene {

/// Appends every material of the document, and asks `textures` for their textures. Throws Error(bad_input)
/// for a model in extras.phos that phos does not have (named), or a parameter that is negative or not a
/// number.
void read_gltf_materials(const GltfDocument& document, TexturePool& textures, Scene& scene);

}  // namespace phos::inline scene
