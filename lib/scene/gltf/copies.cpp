#include "scene/gltf/copies.h"

#include <tiny_gltf.h>

#include <cmath>

#include "core/float_traps.h"
#include "scene/gltf/accessor.h"
#include "scene/motion/animation.h"

namespace phos::inline scene {
namespace {

bool all_finite(const std::vector<float>& values) {
  const NoFloatTraps traps;  // files may hold numbers that are not finite
  for (const float v : values)
    if (!std::isfinite(v)) return false;
  return true;
}

}  // namespace

std::optional<GltfCopies> GltfCopies::of(const GltfDocument& document, std::size_t node) {
  const Json* extension =
      find_path(element(document.json, "nodes", node), "extensions/EXT_mesh_gpu_instancing");
  if (!extension) return std::nullopt;
  const std::string place = text("nodes[", node, "].EXT_mesh_gpu_instancing");
  GltfCopies out;
  const Json::Object& attributes = extension->find("attributes")->as_object();
  if (attributes.empty()) document.fail(place + " has no attributes");
  const std::string* first = nullptr;
  for (const auto& [name, accessor] : attributes) {
    const auto index = static_cast<int>(accessor.as_number());
    const tinygltf::Accessor& from = document.model->accessors[static_cast<std::size_t>(index)];
    if (first && from.count != out.count_)
      document.fail(text(place, ": ", name, " has ", from.count, " values, ", *first, " has ", out.count_));
    first = &name;
    out.count_ = from.count;
    std::vector<float>* to = name == "TRANSLATION" ? &out.translation_
                             : name == "ROTATION"  ? &out.rotation_
                             : name == "SCALE"     ? &out.scale_
                                                   : nullptr;
    if (!to) continue;
    if (from.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !from.normalized)
      document.fail(text(place, ": ", name, " must be floats or normalized integers"));
    *to = read_floats(document, index, to == &out.rotation_ ? 4 : 3);
    if (!all_finite(*to)) document.fail(text(place, ": ", name, " holds values that are not finite"));
  }
  return out;
}

glm::dmat4 GltfCopies::at(std::size_t k) const {
  NodePose pose;
  if (!translation_.empty())
    pose.translation = {translation_[3 * k], translation_[3 * k + 1], translation_[3 * k + 2]};
  if (!rotation_.empty())
    pose.rotation = {rotation_[4 * k + 3], rotation_[4 * k], rotation_[4 * k + 1], rotation_[4 * k + 2]};
  if (!scale_.empty()) pose.scale = {scale_[3 * k], scale_[3 * k + 1], scale_[3 * k + 2]};
  return pose.local();
}

}  // namespace phos::inline scene
