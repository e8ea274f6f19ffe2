#include "scene/motion/animation.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "core/float_traps.h"
#include "scene/gltf/accessor.h"

namespace phos::inline scene {
namespace {

glm::dquat quaternion(const float* v) { return {v[3], v[0], v[1], v[2]}; }

void slerp_into(const float* a, const float* b, double t, std::vector<float>& out) {
  const glm::dquat q = glm::slerp(glm::normalize(quaternion(a)), glm::normalize(quaternion(b)), t);
  out = {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), static_cast<float>(q.w)};
}

void make_unit(std::vector<float>& q) {
  double length = 0;
  for (const float v : q) length += static_cast<double>(v) * v;
  if (length == 0) return;
  for (float& v : q) v = static_cast<float>(v / std::sqrt(length));
}

/// glTF 2.0, appendix C.5: Hermite spline with tangents per second.
void cubic_into(const Keyframes& keys, std::size_t k, double t, double span_s, std::vector<float>& out) {
  const double t2 = t * t, t3 = t2 * t;
  const std::size_t w = keys.width;
  const float* from = keys.value.data() + 3 * w * k;
  const float* to = from + 3 * w;
  out.resize(w);
  for (std::size_t c = 0; c < w; ++c) {
    const double value = (2 * t3 - 3 * t2 + 1) * from[w + c] + span_s * (t3 - 2 * t2 + t) * from[2 * w + c] +
                         (-2 * t3 + 3 * t2) * to[w + c] + span_s * (t3 - t2) * to[c];
    out[c] = static_cast<float>(value);
  }
}

const double* or_null(const std::vector<double>& v, std::size_t n) {
  return v.size() == n ? v.data() : nullptr;
}

}  // namespace

std::vector<float> sample_keyframes(const Keyframes& keys, double time_s) {
  const std::size_t n = keys.time_s.size(), w = keys.width;
  const bool cubic = keys.interpolation == Interpolation::cubic_spline;
  const auto key_value = [&](std::size_t k) {
    const float* v = keys.value.data() + (cubic ? 3 * w * k + w : w * k);
    std::vector<float> out(v, v + w);
    if (keys.rotation) make_unit(out);
    return out;
  };
  // Files have times in float: the key of a frame is met at that frame.
  const auto after = std::upper_bound(keys.time_s.begin(), keys.time_s.end(), static_cast<float>(time_s));
  if (after == keys.time_s.begin()) return key_value(0);
  const auto k = static_cast<std::size_t>(after - keys.time_s.begin()) - 1;
  if (k + 1 >= n || keys.interpolation == Interpolation::step) return key_value(k);
  const double span_s = static_cast<double>(keys.time_s[k + 1]) - keys.time_s[k];
  const double t = std::clamp((time_s - keys.time_s[k]) / span_s, 0.0, 1.0);
  std::vector<float> out;
  if (cubic) {
    cubic_into(keys, k, t, span_s, out);
    if (keys.rotation) make_unit(out);
    return out;
  }
  const float* a = keys.value.data() + w * k;
  if (keys.rotation) {
    slerp_into(a, a + w, t, out);
    return out;
  }
  for (std::size_t c = 0; c < w; ++c) out.push_back(static_cast<float>((1 - t) * a[c] + t * a[w + c]));
  return out;
}

glm::dmat4 NodePose::local() const {
  if (has_matrix) return matrix;
  const double length = glm::length(rotation);
  const glm::dquat unit = length > 0 ? rotation / length : glm::dquat(1, 0, 0, 0);
  return glm::translate(glm::dmat4(1), translation) * glm::mat4_cast(unit) * glm::scale(glm::dmat4(1), scale);
}

std::vector<NodePose> rest_poses(const GltfDocument& document) {
  std::vector<NodePose> poses;
  for (const tinygltf::Node& node : document.model->nodes) {
    NodePose& pose = poses.emplace_back();
    if (const double* m = or_null(node.matrix, 16)) {
      pose.has_matrix = true;
      for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) pose.matrix[c][r] = m[4 * c + r];
      }
    }
    if (const double* t = or_null(node.translation, 3)) pose.translation = {t[0], t[1], t[2]};
    if (const double* r = or_null(node.rotation, 4)) pose.rotation = {r[3], r[0], r[1], r[2]};
    if (const double* s = or_null(node.scale, 3)) pose.scale = {s[0], s[1], s[2]};
    for (const double w : node.weights) pose.weights.push_back(static_cast<float>(w));
  }
  return poses;
}

namespace {

/// One channel: where its values go.
struct Target {
  int node = -1;
  std::string path, pointer;
};

Target target_of(const Json& channel) {
  Target target;
  target.path = text_at(channel, "target/path", "");
  target.node = static_cast<int>(number_at(channel, "target/node", -1));
  target.pointer = text_at(channel, "target/extensions/KHR_animation_pointer/pointer", "");
  // "/nodes/3/rotation" is the ordinary target in other words.
  int node = 0, length = 0;
  char path[16] = "";
  if (std::sscanf(target.pointer.c_str(), "/nodes/%d/%15[a-z]%n", &node, path, &length) == 2 &&
      static_cast<std::size_t>(length) == target.pointer.size()) {
    target.node = node;
    target.path = path;
    target.pointer.clear();
  }
  return target;
}

/// Does the reader of that list ask for the property that a pointer sets?
bool is_asked_for(const std::string& pointer) {
  constexpr const char* kPointers[] = {
      "/nodes/%d/extensions/KHR_node_visibility/visible%n",
      "/materials/%d/emissiveFactor%n",
      "/materials/%d/extensions/KHR_materials_emissive_strength/emissiveStrength%n",
      "/extensions/KHR_lights_punctual/lights/%d/color%n",
      "/extensions/KHR_lights_punctual/lights/%d/intensity%n",
      "/extensions/KHR_lights_punctual/lights/%d/spot/innerConeAngle%n",
      "/extensions/KHR_lights_punctual/lights/%d/spot/outerConeAngle%n",
  };
  for (const char* form : kPointers) {
    int index = 0, length = 0;
    // The form is one of those above.
    if (std::sscanf(pointer.c_str(), form, &index, &length) == 1 && length > 0 &&
        static_cast<std::size_t>(length) == pointer.size())
      return true;
  }
  return false;
}

class Animator {
 public:
  Animator(GltfDocument& document, Scene& scene, std::vector<NodePose>& poses)
      : document_(document), scene_(scene), poses_(poses) {}

  void apply(const Json& from, std::size_t index) {
    Animation animation;
    animation.name = text_at(from, "name", text("animation ", index));
    animation.start_s = std::numeric_limits<double>::infinity();
    place_ = text("animations[", index, "]");
    name_ = animation.name;
    for (const Json& channel : from.find("channels")->as_array()) {
      const Target target = target_of(channel);
      const auto sampler = static_cast<std::size_t>(channel.find("sampler")->as_number());
      if (target.node < 0 && target.pointer.empty()) continue;  // as glTF asks
      const Keyframes keys = read_keys(from.find("samplers")->as_array()[sampler], target.path == "rotation");
      const std::vector<float> value = sample_keyframes(keys, scene_.time_s);
      for (const float v : value) {
        if (!std::isfinite(v)) document_.fail(place_ + " gives a value that is not finite");
      }
      animation.start_s = std::min(animation.start_s, static_cast<double>(keys.time_s.front()));
      animation.end_s = std::max(animation.end_s, static_cast<double>(keys.time_s.back()));
      animation.targets.push_back(set(target, value));
    }
    if (animation.targets.empty()) return;
    scene_.animation.push_back(std::move(animation));
  }

 private:
  Keyframes read_keys(const Json& sampler, bool rotation) const {
    Keyframes keys;
    const auto output = static_cast<int>(sampler.find("output")->as_number());
    keys.time_s = read_floats(document_, static_cast<int>(sampler.find("input")->as_number()), 1);
    keys.value = read_floats(document_, output, accessor_components(document_, output));
    keys.rotation = rotation;
    const std::string interpolation = text_at(sampler, "interpolation", "LINEAR");
    if (interpolation == "STEP") keys.interpolation = Interpolation::step;
    if (interpolation == "CUBICSPLINE") keys.interpolation = Interpolation::cubic_spline;
    const std::size_t per_key = keys.interpolation == Interpolation::cubic_spline ? 3 : 1;
    if (keys.time_s.empty()) document_.fail(place_ + " has no keys");
    keys.width = keys.value.size() / (keys.time_s.size() * per_key);
    if (keys.width == 0) document_.fail(place_ + " has fewer values than keys");
    const NoFloatTraps traps;  // files may hold numbers that are not finite
    for (std::size_t i = 0; i < keys.time_s.size(); ++i) {
      if (!std::isfinite(keys.time_s[i]) || (i > 0 && keys.time_s[i] <= keys.time_s[i - 1]))
        document_.fail(place_ + " has keys that do not increase");
    }
    if (rotation && keys.width != 4) document_.fail(place_ + " has a rotation that is no quaternion");
    return keys;
  }

  std::string set(const Target& target, const std::vector<float>& value) {
    if (!target.pointer.empty()) {
      document_.animated[target.pointer] = value;
      if (!is_asked_for(target.pointer)) tell(target.pointer);
      return target.pointer;
    }
    if (static_cast<std::size_t>(target.node) >= poses_.size())
      document_.fail(place_ + " moves a node that is not there");
    const auto n = static_cast<std::size_t>(target.node);
    NodePose& pose = poses_[n];
    const std::string name = document_.model->nodes[n].name;
    const std::string label = text("node ", name.empty() ? std::to_string(n) : name, " ", target.path);
    const bool vector = target.path == "translation" || target.path == "scale";
    if (vector && value.size() != 3)
      document_.fail(place_ + " has a " + target.path + " without three numbers");
    if (pose.has_matrix && (vector || target.path == "rotation")) {
      document_.fail(place_ + " moves a node that has a matrix; give it translation, rotation and scale");
    }
    if (target.path == "translation") pose.translation = {value[0], value[1], value[2]};
    if (target.path == "scale") pose.scale = {value[0], value[1], value[2]};
    if (target.path == "rotation") pose.rotation = quaternion(value.data());
    if (target.path == "weights") pose.weights = value;
    if (!vector && target.path != "rotation" && target.path != "weights") tell(label);
    return label;
  }

  void tell(const std::string& target) {
    scene_.warnings.emplace_back(Note::Level::warning, kExtension, "animation", name_,
                                 target + " is not moved: it stays as the file states it");
  }

  GltfDocument& document_;
  Scene& scene_;
  std::vector<NodePose>& poses_;
  std::string place_, name_;
};

}  // namespace

void apply_animations(GltfDocument& document, Scene& scene, std::vector<NodePose>& poses) {
  Animator animator(document, scene, poses);
  for (std::size_t i = 0; i < count_at(document.json, "animations"); ++i) {
    animator.apply(element(document.json, "animations", i), i);
  }
}

}  // namespace phos::inline scene
