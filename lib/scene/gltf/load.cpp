#include "scene/gltf/load.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "scene/gltf/accessor.h"
#include "scene/gltf/coats.h"
#include "scene/gltf/copies.h"
#include "scene/gltf/document.h"
#include "scene/gltf/findings.h"
#include "scene/gltf/luminaires.h"
#include "scene/gltf/material.h"
#include "scene/gltf/mesh.h"
#include "scene/lamp/spot_cone.h"
#include "scene/load_mesh.h"
#include "scene/luminaire/hang.h"
#include "scene/material/glass_sheets.h"
#include "scene/motion/animation.h"
#include "scene/node_extent.h"
#include "scene/texture/load_textures.h"

namespace phos::inline scene {
namespace {

class SceneReader {
 public:
  SceneReader(GltfDocument& document, Scene& scene, const LuminaireOptions& luminaires)
      : document_(document),
        scene_(scene),
        profiles_(document),
        luminaires_as_(luminaires.as),
        given_(luminaires) {}

  void read(const SceneOptions& options) {
    read_time(options);
    for (const auto find : {gltf_findings, metals_by_default}) {
      const std::vector<Note> notes = find(document_.json);
      scene_.warnings.insert(scene_.warnings.end(), notes.begin(), notes.end());
    }
    const std::vector<NodePose> rest = rest_poses(document_);
    std::vector<NodePose> poses = rest;
    apply_animations(document_, scene_, poses);
    read_length();
    TexturePool textures;
    read_gltf_materials(document_, textures, scene_);
    textures.decode(scene_);
    lay_coats(document_, scene_);
    choose_origin(rest);
    place_nodes(poses);
    for (const std::size_t node : order_) read_node(node, poses[node]);
    make_sheets_thin(scene_);
    given_.require_all_found();
    if (skipped_primitives_) {
      scene_.warnings.emplace_back(
          Note::Level::info, "loader", "", "",
          text(skipped_primitives_, " mesh primitives are points or lines, which give no surface"));
    }
  }

 private:
  const Json& default_scene() const {
    return element(document_.json, "scenes", static_cast<std::size_t>(number_at(document_.json, "scene", 0)));
  }

  void read_time(const SceneOptions& options) {
    if (const Json* fps = find_path(default_scene(), "extras/animation/fps"); fps && fps->is_number()) {
      if (!(fps->as_number() > 0)) document_.fail("scenes[].extras.animation.fps must be above 0");
      scene_.frames_per_s = fps->as_number();
    }
    if (options.time_s) scene_.time_s = *options.time_s;
    if (options.frame) scene_.time_s = *options.frame / scene_.frames_per_s;
  }

  void read_length() {
    double end_s = 0;
    for (const Animation& a : scene_.animation) end_s = std::max(end_s, a.end_s);
    if (!scene_.animation.empty())
      scene_.frames = std::llround(std::min(end_s * scene_.frames_per_s, 1e15)) + 1;
    const Json* frames = find_path(default_scene(), "extras/animation/frames");
    if (frames && frames->is_number())
      scene_.frames = std::llround(std::clamp(frames->as_number(), 0.0, 1e15));
  }

  std::vector<std::size_t> roots() const {
    std::vector<std::size_t> out;
    if (count_at(document_.json, "scenes") == 0) {  // no scene to choose: every node without a parent
      std::set<int> children;
      for (const tinygltf::Node& node : document_.model->nodes)
        children.insert(node.children.begin(), node.children.end());
      for (std::size_t i = 0; i < document_.model->nodes.size(); ++i) {
        if (!children.count(static_cast<int>(i))) out.push_back(i);
      }
      return out;
    }
    if (const Json* nodes = default_scene().find("nodes")) {
      for (const Json& n : nodes->as_array()) out.push_back(static_cast<std::size_t>(n.as_number()));
    }
    return out;
  }

  /// By the poses that the file states, so that it is the same at every time.
  void choose_origin(const std::vector<NodePose>& rest) {
    place_nodes(rest);
    NodeExtent extent;
    for (const std::size_t i : order_) {
      const tinygltf::Node& node = document_.model->nodes[i];
      if (node.mesh < 0) continue;
      const auto mesh = static_cast<std::size_t>(node.mesh);
      std::vector<glm::dmat4> to_world{world_[i]};
      if (node.skin >= 0) to_world = joints(static_cast<std::size_t>(node.skin));
      if (shown_[i] == Shown::never) continue;
      if (const std::optional<GltfCopies> copies = GltfCopies::of(document_, i)) {
        const std::vector<glm::dmat4> placed = std::move(to_world);
        to_world.clear();
        for (std::size_t k = 0; k < copies->size(); ++k)
          for (const glm::dmat4& m : placed) to_world.push_back(m * copies->at(k));
      }
      const std::vector<float> weights = weights_of(mesh, rest[i]);
      for (std::size_t p = 0; p < document_.model->meshes[mesh].primitives.size(); ++p) {
        const std::optional<MeshData>& data = primitive(mesh, p, weights);
        if (!data) continue;
        for (const glm::dmat4& m : to_world) extent.include(data->position, m, mesh_name(mesh));
      }
    }
    scene_.origin_m = suitable_origin_m(extent.world());
    if (std::string coarse = extent.coarse(); !coarse.empty())
      scene_.warnings.emplace_back(Note::Level::info, "loader", "", "", std::move(coarse));
  }

  /// Transforms from the scene's origin, depth first in file order. Every node has one parent, so that a
  /// second visit is a mistake.
  void place_nodes(const std::vector<NodePose>& poses) {
    order_.clear();
    const glm::dmat4 from_origin = glm::translate(glm::dmat4(1), -scene_.origin_m);
    const std::size_t n = document_.model->nodes.size();
    world_.assign(n, glm::dmat4(1));
    shown_.assign(n, Shown::yes);
    std::vector<bool> seen(n, false);
    std::vector<std::pair<std::size_t, glm::dmat4>> stack;
    const std::vector<std::size_t> first = roots();
    for (auto it = first.rbegin(); it != first.rend(); ++it) stack.emplace_back(*it, from_origin);
    while (!stack.empty()) {
      const auto [node, parent] = stack.back();
      stack.pop_back();
      if (seen[node]) document_.fail(text("nodes[", node, "] is its own ancestor or has two parents"));
      seen[node] = true;
      world_[node] = parent * poses[node].local();
      for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
          if (!std::isfinite(world_[node][c][r]))
            document_.fail(text("nodes[", node, "] has a transform that is not finite"));
        }
      }
      order_.push_back(node);
      shown_[node] = std::max(shown_[node], own_visibility(node));
      const std::vector<int>& children = document_.model->nodes[node].children;
      for (auto it = children.rbegin(); it != children.rend(); ++it) {
        shown_[static_cast<std::size_t>(*it)] = shown_[node];
        stack.emplace_back(static_cast<std::size_t>(*it), world_[node]);
      }
    }
  }

  /// KHR_node_visibility. What an animation hides stays in the scene without an extent, so that its triangles
  /// are the same at every time.
  enum class Shown : std::uint8_t { yes, not_now, never };
  Shown own_visibility(std::size_t node) const {
    constexpr const char* kVisible = "extensions/KHR_node_visibility/visible";
    const auto animated = document_.animated.find(text("/nodes/", node, "/", kVisible));
    if (animated != document_.animated.end() && !animated->second.empty())
      return animated->second[0] != 0 ? Shown::yes : Shown::not_now;
    const Json* visible = find_path(element(document_.json, "nodes", node), kVisible);
    return visible && !visible->as_bool() ? Shown::never : Shown::yes;
  }

  std::string node_name(std::size_t node) const {
    const std::string& name = document_.model->nodes[node].name;
    return name.empty() ? text("node ", node) : name;
  }

  void read_node(std::size_t index, const NodePose& pose) {
    const tinygltf::Node& node = document_.model->nodes[index];
    if (node.mesh >= 0) read_mesh(index, static_cast<std::size_t>(node.mesh), node.skin, pose);
    if (node.camera >= 0) read_camera(index, static_cast<std::size_t>(node.camera));
    if (const Json* light =
            find_path(element(document_.json, "nodes", index), "extensions/KHR_lights_punctual/light")) {
      read_light(index, static_cast<std::size_t>(light->as_number()));
    }
    if (const std::optional<GltfLuminaire> luminaire = gltf_luminaire(document_.json, index))
      read_luminaire(index, *luminaire);
  }

  void read_luminaire(std::size_t node, const GltfLuminaire& luminaire) {
    const std::string& name = document_.model->nodes[node].name;
    LuminairePlace place{!name.empty() ? name : luminaire.name, world_[node], luminaire.colour};
    if (place.name.empty()) place.name = node_name(node);
    note_spectrum(
        place.name,
        find_path(document_.json, "extensions/EXT_lights_ies/lights")->as_array()[luminaire.profile]);
    std::shared_ptr<const PhotometricFile> file = given_.find(place.name);
    if (shown_[node] != Shown::yes) return;
    if (!file) file = profiles_.read(luminaire.profile);
    hang_luminaire(scene_, std::move(file), place, luminaires_as_);
  }

  /// A light whose distribution the options give. Its colour stays, the file says how bright it is.
  void hang_in_place_of(const Light& light, const Rgb& hue, std::size_t node,
                        std::shared_ptr<const PhotometricFile> file) {
    LuminairePlace place{light.name, world_[node], hue};
    if (light.kind == Light::Kind::point) {
      const double scale = std::cbrt(std::fabs(glm::determinant(glm::dmat3(world_[node]))));
      place.to_world = hanging_down(DVec3(world_[node][3]), DVec3(world_[node][0]), scale);
    }
    hang_luminaire(scene_, std::move(file), place, luminaires_as_);
  }

  void read_mesh(std::size_t node, std::size_t mesh, int skin, const NodePose& pose) {
    const tinygltf::Mesh& from = document_.model->meshes[mesh];
    if (shown_[node] == Shown::never) return;
    const std::vector<float> weights = weights_of(mesh, pose);
    const std::optional<GltfCopies> copies = GltfCopies::of(document_, node);
    for (std::size_t p = 0; p < from.primitives.size(); ++p) {
      const std::string what = mesh_name(mesh);
      std::optional<MeshData> data = primitive(mesh, p, weights);
      if (!data) {
        ++skipped_primitives_;
        continue;
      }
      glm::dmat4 to_world = world_[node];
      if (skin >= 0 && apply_skin(document_, mesh, p, joints(static_cast<std::size_t>(skin)), *data)) {
        to_world = glm::dmat4(1);
      }
      const std::uint32_t material = material_of(from.primitives[p].material);
      const Material& m = scene_.material[material];
      const bool tangents = m.normal.used() || m.anisotropic();
      if (shown_[node] == Shown::not_now) to_world[0] = to_world[1] = to_world[2] = glm::dvec4(0);
      if (!copies) {
        add_instance(scene_, std::move(*data), to_world, node_name(node), material, tangents, what);
        continue;
      }
      for (std::size_t k = 0; k < copies->size(); ++k)
        add_instance(scene_, *data, to_world * copies->at(k), text(node_name(node), "[", k, "]"), material,
                     tangents, what);
    }
  }

  std::string mesh_name(std::size_t mesh) const {
    const std::string& name = document_.model->meshes[mesh].name;
    return text("mesh \"", name.empty() ? std::to_string(mesh) : name, "\"");
  }

  std::vector<float> weights_of(std::size_t mesh, const NodePose& pose) const {
    if (!pose.weights.empty()) return pose.weights;
    std::vector<float> weights;
    for (const double w : document_.model->meshes[mesh].weights) weights.push_back(static_cast<float>(w));
    return weights;
  }

  /// Meshes that many nodes share are read once.
  const std::optional<MeshData>& primitive(std::size_t mesh, std::size_t p,
                                           const std::vector<float>& weights) {
    if (!weights.empty()) return morphed_ = read_primitive(document_, mesh, p, weights);
    const auto [it, fresh] = primitives_.try_emplace({mesh, p});
    if (fresh) it->second = read_primitive(document_, mesh, p, weights);
    return it->second;
  }

  std::vector<glm::dmat4> joints(std::size_t skin) const {
    const tinygltf::Skin& from = document_.model->skins[skin];
    std::vector<float> inverse_bind;
    if (from.inverseBindMatrices >= 0) inverse_bind = read_floats(document_, from.inverseBindMatrices, 16);
    std::vector<glm::dmat4> out;
    for (std::size_t j = 0; j < from.joints.size(); ++j) {
      glm::dmat4 bind(1);
      if (inverse_bind.size() >= 16 * (j + 1)) {
        for (int c = 0; c < 4; ++c) {
          for (int r = 0; r < 4; ++r) bind[c][r] = inverse_bind[16 * j + static_cast<std::size_t>(4 * c + r)];
        }
      }
      out.push_back(world_[static_cast<std::size_t>(from.joints[j])] * bind);
    }
    return out;
  }

  std::uint32_t material_of(int index) {
    if (index >= 0) return static_cast<std::uint32_t>(index);
    if (!default_material_) {
      default_material_ = static_cast<std::uint32_t>(scene_.material.size());
      Material
          m;  // glTF's default is a white metal of roughness 1, which nobody means: white paint stands in
      m.name = "default";
      m.kd = Rgb(0.5f);
      scene_.material.push_back(m);
      scene_.warnings.emplace_back("some meshes have no material: they are read as grey Lambert, kd 0.5");
    }
    return *default_material_;
  }

  /// The node's axes, without its scale.
  static Mat4 rigid(const glm::dmat4& m) {
    glm::dmat4 out(m);
    for (int c = 0; c < 3; ++c) {
      const double length = glm::length(DVec3(m[c]));
      DVec3 axis(0);
      axis[c] = 1;
      out[c] = glm::dvec4(length > 0 && std::isfinite(length) ? DVec3(m[c]) / length : axis, 0);
    }
    return Mat4(out);
  }

  void read_camera(std::size_t node, std::size_t index) {
    const tinygltf::Camera& from = document_.model->cameras[index];
    Camera camera;
    camera.name = !from.name.empty() ? from.name : node_name(node);
    camera.to_world = rigid(world_[node]);
    const Json& json = element(document_.json, "cameras", index);
    const auto fail = [&](const char* what) { document_.fail(text("cameras[", index, "].", what)); };
    if (from.type == "perspective" && json.find("perspective")) {
      camera.yfov_rad = static_cast<float>(from.perspective.yfov);
      if (!(camera.yfov_rad > 0 && camera.yfov_rad < kPi)) fail("perspective.yfov must be between 0 and pi");
      if (from.perspective.aspectRatio > 0) camera.aspect = static_cast<float>(from.perspective.aspectRatio);
    } else if (from.type == "orthographic" && json.find("orthographic")) {
      camera.perspective = false;
      camera.ymag_m = static_cast<float>(std::abs(from.orthographic.ymag));
      if (!(camera.ymag_m > 0)) fail("orthographic.ymag must not be 0");
      const auto xmag = static_cast<float>(std::abs(from.orthographic.xmag));
      if (xmag > 0) camera.aspect = xmag / camera.ymag_m;
    } else {
      fail("type must be perspective or orthographic, with its values");
    }
    scene_.camera.push_back(camera);
  }

  /// A light's number as the file or, at this time, an animation pointer has it.
  double light_number(std::size_t index, const char* key, double absent) const {
    const auto it = document_.animated.find(text("/extensions/KHR_lights_punctual/lights/", index, "/", key));
    if (it != document_.animated.end() && it->second.size() == 1) return it->second[0];
    return number_at(light_json(index), key, absent);
  }

  const Json& light_json(std::size_t index) const {
    return find_path(document_.json, "extensions/KHR_lights_punctual/lights")->as_array()[index];
  }

  Rgb light_colour(std::size_t index) const {
    const auto it = document_.animated.find(text("/extensions/KHR_lights_punctual/lights/", index, "/color"));
    if (it != document_.animated.end() && it->second.size() == 3)
      return {it->second[0], it->second[1], it->second[2]};
    return rgb_at(light_json(index), "color").value_or(Rgb(1));
  }

  void read_light(std::size_t node, std::size_t index) {
    const Json& json = light_json(index);
    Light light;
    const std::string& name = document_.model->nodes[node].name;
    light.name = !name.empty() ? name : text_at(json, "name", node_name(node));
    if (shown_[node] != Shown::yes) return static_cast<void>(given_.find(light.name));
    const Mat4 axes = rigid(world_[node]);
    light.position = Vec3(axes[3]);
    light.direction = -Vec3(axes[2]);
    light.intensity = light_colour(index) * static_cast<float>(light_number(index, "intensity", 1));
    const auto fail = [&](const std::string& what) {
      document_.fail(text("light \"", light.name, "\": ", what));
    };
    if (!is_finite(light.intensity) || light.intensity.x < 0 || light.intensity.y < 0 ||
        light.intensity.z < 0) {
      fail("intensity and color must not be negative");
    }
    if (!is_finite(light.position)) fail("its position is not finite");
    const std::string type = text_at(json, "type", "");
    if (type == "point") {
      light.kind = Light::Kind::point;
    } else if (type == "directional") {
      light.kind = Light::Kind::directional;
    } else if (type == "spot") {
      light.kind = Light::Kind::spot;
      const double inner = light_number(index, "spot/innerConeAngle", 0);
      const double outer = light_number(index, "spot/outerConeAngle", 0.25 * std::numbers::pi);
      if (!set_spot_cone(light, inner, outer))
        fail(text("its cone angles must satisfy 0 <= inner <= outer <= pi/2, outer above 0; they are ",
                  shortest(static_cast<float>(inner)), " and ", shortest(static_cast<float>(outer)), " rad"));
    } else {
      fail("type \"" + type + "\" is not point, spot or directional");
    }
    note_spectrum(light.name, json);
    if (light.kind != Light::Kind::directional) {
      if (std::shared_ptr<const PhotometricFile> file = given_.find(light.name))
        return hang_in_place_of(light, hue(light_colour(index)), node, std::move(file));
    }
    scene_.light.push_back(light);
  }

  void note_spectrum(const std::string& light, const Json& json) {
    try {
      if (std::string file = spectrum_file(document_.path, json); !file.empty())
        scene_.light_spectrum[light] = std::move(file);
    } catch (const std::runtime_error& e) {
      document_.fail(text("light \"", light, "\": ", e.what()));
    }
  }

  GltfDocument& document_;
  Scene& scene_;
  GltfProfiles profiles_;
  LuminairesAs luminaires_as_;
  GivenLuminaires given_;
  std::vector<glm::dmat4> world_;
  std::vector<std::size_t> order_;
  std::vector<Shown> shown_;  // with all above it
  std::map<std::pair<std::size_t, std::size_t>, std::optional<MeshData>> primitives_;
  std::optional<MeshData> morphed_;  // the last that was read with weights
  std::optional<std::uint32_t> default_material_;
  std::uint64_t skipped_primitives_ = 0;
};

}  // namespace

Scene load_gltf(const std::string& path, std::string_view bytes, const SceneOptions& options) {
  GltfDocument document = read_gltf(path, bytes);
  Scene scene;
  scene.path = path;
  SceneReader(document, scene, options.luminaires).read(options);
  return scene;
}

}  // namespace phos::inline scene
