// How far placed meshes reach in the world, before anything is rounded to where they are.
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "core/origin.h"

namespace phos::inline scene {

class NodeExtent {
 public:
  /// The box about these vertices, placed. `what` names the mesh in coarse().
  void include(const std::vector<Vec3>& local, const glm::dmat4& to_world, const std::string& what);
  const DBounds& world() const { return world_; }
  /// A warning if the rounding of some mesh's own vertices is more than a hundred thousandth of the whole:
  /// they hold an offset that belongs into the transform of the node. Else empty.
  std::string coarse() const;

 private:
  DBounds world_;
  double rounding_m_ = 0, farthest_m_ = 0;  // of the vertices rounded most, and how far they are off
  std::string what_;
};

}  // namespace phos::inline scene
