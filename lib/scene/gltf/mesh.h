// A glTF mesh primitive as triangles, morphed and skinned.
#pragma once

#include <optional>

#include "scene/gltf/document.h"
#include "scene/load_mesh.h"

namespace phos::inline scene {

/// Triangles of meshes[mesh].primitives[primitive], with its morph targets blended by `weights` (missing ones
/// are 0). Nothing for points and lines. Throws Error(bad_input).
std::optional<MeshData> read_primitive(const GltfDocument& document, std::size_t mesh, std::size_t primitive,
                                       const std::vector<float>& weights);

/// Moves the vertices of a skinned primitive by their joints; `joint` holds, per joint, world transform times
/// inverse bind matrix. The result is in world coordinates. False if the primitive has no joints.
bool apply_skin(const GltfDocument& document, std::size_t mesh, std::size_t primitive,
                const std::vector<glm::dmat4>& joint, MeshData& data);

}  // namespace phos::inline scene
