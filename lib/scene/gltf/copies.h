// EXT_mesh_gpu_instancing: many copies of the mesh of a node.
#pragma once

#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "scene/gltf/document.h"

namespace phos::inline scene {

/// Where the copies stand, in the coordinates of their node. 40 bytes a copy.
class GltfCopies {
 public:
  /// Nothing where the node has no such extension. Throws Error(bad_input) for attributes of different
  /// lengths, of other types than the extension allows, or that are not finite, and where there are none.
  static std::optional<GltfCopies> of(const GltfDocument& document, std::size_t node);

  std::size_t size() const { return count_; }
  /// Translation, rotation (made unit) and scale of copy k < size().
  glm::dmat4 at(std::size_t k) const;

 private:
  std::vector<float> translation_, rotation_, scale_;  // empty: none
  std::size_t count_ = 0;
};

}  // namespace phos::inline scene
