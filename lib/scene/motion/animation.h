// Keyframes and the pose of nodes at a time.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace phos::inline scene {

enum class Interpolation { step, linear, cubic_spline };

/// One glTF animation sampler. `value` holds `width` numbers per key; with cubic_spline three times as many
/// (in-tangent, value, out-tangent).
struct Keyframes {
  std::vector<float> time_s;
  std::vector<float> value;
  std::size_t width = 0;
  Interpolation interpolation = Interpolation::linear;
  bool rotation = false;  ///< values are quaternions (x, y, z, w): slerp, and unit results
};

/// The value at `time_s`; before the first and after the last key, theirs (glTF 2.0, section 3.11).
std::vector<float> sample_keyframes(const Keyframes& keys, double time_s);

/// A node's own transform.
struct NodePose {
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};
  glm::dvec3 scale{1};
  bool has_matrix = false;
  glm::dmat4 matrix{1};
  std::vector<float> weights;  ///< of morph targets; empty: the mesh's own
  glm::dmat4 local() const;
};

/// Poses as the file states them. Throws Error(bad_input).
std::vector<NodePose> rest_poses(const GltfDocument& document);

/// Applies every channel of every animation, in file order, at scene.time_s: node transforms to `poses`,
/// pointers (KHR_animation_pointer) to document.animated. Fills scene.animation; unsupported targets are
/// warnings. Throws Error(bad_input) for keys that are not increasing or too few values.
void apply_animations(GltfDocument& document, Scene& scene, std::vector<NodePose>& poses);

}  // namespace phos::inline scene
