#include "scene/gltf/check.h"

#include <cmath>
#include <limits>

#include "core/error.h"
#include "scene/gltf/document.h"
#include "scene/gltf/luminaires.h"

namespace phos::inline scene {
namespace {

enum class Kind { index, indices, count, small_count, number, numbers, text, boolean };

/// What the member `key` of each element of the top-level array `list` must be.
struct Rule {
  const char* list;
  const char* key;
  Kind kind;
  const char* target = "";       ///< index, indices: into this array
  std::size_t length = 0;        ///< numbers: how many; 0 is any
  const char* required_by = "";  ///< member that makes this one required; "." is always
};

constexpr Rule kRules[] = {
    {"buffers", "byteLength", Kind::count, "", 0, "."},
    {"buffers", "uri", Kind::text},
    {"bufferViews", "buffer", Kind::index, "buffers", 0, "."},
    {"bufferViews", "byteOffset", Kind::count},
    {"bufferViews", "byteLength", Kind::count, "", 0, "."},
    {"bufferViews", "byteStride", Kind::small_count},
    {"accessors", "bufferView", Kind::index, "bufferViews"},
    {"accessors", "byteOffset", Kind::count},
    {"accessors", "count", Kind::count, "", 0, "."},
    {"accessors", "componentType", Kind::small_count, "", 0, "."},
    {"accessors", "type", Kind::text, "", 0, "."},
    {"accessors", "normalized", Kind::boolean},
    {"accessors", "min", Kind::numbers},
    {"accessors", "max", Kind::numbers},
    {"accessors", "sparse/count", Kind::small_count, "", 0, "sparse"},
    {"accessors", "sparse/indices/bufferView", Kind::index, "bufferViews", 0, "sparse"},
    {"accessors", "sparse/indices/byteOffset", Kind::small_count},
    {"accessors", "sparse/indices/componentType", Kind::small_count, "", 0, "sparse"},
    {"accessors", "sparse/values/bufferView", Kind::index, "bufferViews", 0, "sparse"},
    {"accessors", "sparse/values/byteOffset", Kind::small_count},
    {"images", "bufferView", Kind::index, "bufferViews"},
    {"images", "uri", Kind::text},
    {"images", "name", Kind::text},
    {"samplers", "magFilter", Kind::small_count},
    {"samplers", "minFilter", Kind::small_count},
    {"samplers", "wrapS", Kind::small_count},
    {"samplers", "wrapT", Kind::small_count},
    {"textures", "source", Kind::index, "images"},
    {"textures", "sampler", Kind::index, "samplers"},
    {"materials", "name", Kind::text},
    {"materials", "pbrMetallicRoughness/baseColorFactor", Kind::numbers, "", 4},
    {"materials", "pbrMetallicRoughness/metallicFactor", Kind::number},
    {"materials", "pbrMetallicRoughness/roughnessFactor", Kind::number},
    {"materials", "pbrMetallicRoughness/baseColorTexture/index", Kind::index, "textures"},
    {"materials", "pbrMetallicRoughness/baseColorTexture/texCoord", Kind::small_count},
    {"materials", "pbrMetallicRoughness/metallicRoughnessTexture/index", Kind::index, "textures"},
    {"materials", "pbrMetallicRoughness/metallicRoughnessTexture/texCoord", Kind::small_count},
    {"materials", "normalTexture/index", Kind::index, "textures"},
    {"materials", "normalTexture/texCoord", Kind::small_count},
    {"materials", "normalTexture/scale", Kind::number},
    {"materials", "emissiveTexture/index", Kind::index, "textures"},
    {"materials", "emissiveTexture/texCoord", Kind::small_count},
    {"materials", "emissiveFactor", Kind::numbers, "", 3},
    {"materials", "alphaMode", Kind::text},
    {"materials", "alphaCutoff", Kind::number},
    {"materials", "doubleSided", Kind::boolean},
    {"materials", "extensions/KHR_materials_anisotropy/anisotropyStrength", Kind::number},
    {"materials", "extensions/KHR_materials_anisotropy/anisotropyRotation", Kind::number},
    {"materials", "extensions/KHR_materials_anisotropy/anisotropyTexture/index", Kind::index, "textures"},
    {"materials", "extensions/KHR_materials_anisotropy/anisotropyTexture/texCoord", Kind::small_count},
    {"materials", "extensions/KHR_materials_clearcoat/clearcoatFactor", Kind::number},
    {"materials", "extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", Kind::number},
    {"materials", "extensions/KHR_materials_sheen/sheenColorFactor", Kind::numbers, "", 3},
    {"materials", "extensions/KHR_materials_sheen/sheenRoughnessFactor", Kind::number},
    {"materials", "extensions/KHR_materials_emissive_strength/emissiveStrength", Kind::number},
    {"materials", "extensions/KHR_materials_ior/ior", Kind::number},
    {"materials", "extensions/KHR_materials_specular/specularFactor", Kind::number},
    {"materials", "extensions/KHR_materials_specular/specularColorFactor", Kind::numbers, "", 3},
    {"materials", "extensions/KHR_materials_transmission/transmissionFactor", Kind::number},
    {"materials", "extensions/KHR_materials_transmission/transmissionTexture/index", Kind::index, "textures"},
    {"materials", "extensions/KHR_materials_transmission/transmissionTexture/texCoord", Kind::small_count},
    {"materials", "extensions/KHR_materials_volume/thicknessFactor", Kind::number},
    {"materials", "extensions/KHR_materials_volume/attenuationDistance", Kind::number},
    {"materials", "extensions/KHR_materials_volume/attenuationColor", Kind::numbers, "", 3},
    {"nodes", "name", Kind::text},
    {"nodes", "mesh", Kind::index, "meshes"},
    {"nodes", "skin", Kind::index, "skins"},
    {"nodes", "camera", Kind::index, "cameras"},
    {"nodes", "children", Kind::indices, "nodes"},
    {"nodes", "matrix", Kind::numbers, "", 16},
    {"nodes", "translation", Kind::numbers, "", 3},
    {"nodes", "rotation", Kind::numbers, "", 4},
    {"nodes", "scale", Kind::numbers, "", 3},
    {"nodes", "weights", Kind::numbers},
    {"nodes", "extensions/KHR_node_visibility/visible", Kind::boolean},
    {"meshes", "name", Kind::text},
    {"meshes", "weights", Kind::numbers},
    {"skins", "joints", Kind::indices, "nodes", 0, "."},
    {"skins", "inverseBindMatrices", Kind::index, "accessors"},
    {"skins", "skeleton", Kind::index, "nodes"},
    {"scenes", "nodes", Kind::indices, "nodes"},
    {"scenes", "name", Kind::text},
    {"cameras", "name", Kind::text},
    {"cameras", "type", Kind::text, "", 0, "."},
    {"cameras", "perspective/yfov", Kind::number, "", 0, "perspective"},
    {"cameras", "perspective/aspectRatio", Kind::number},
    {"cameras", "orthographic/xmag", Kind::number, "", 0, "orthographic"},
    {"cameras", "orthographic/ymag", Kind::number, "", 0, "orthographic"},
};

class Checker {
 public:
  Checker(const Json& document, const std::string& path) : document_(document), path_(path) {}

  void check() const {
    for (const char* key : {"buffers", "bufferViews", "accessors", "images", "samplers", "textures",
                            "materials", "nodes", "meshes", "skins", "scenes", "cameras", "animations"}) {
      check_list(key);
    }
    for (const Rule& rule : kRules) {
      for (std::size_t i = 0; i < count_at(document_, rule.list); ++i) {
        apply(rule, element(document_, rule.list, i), text(rule.list, "[", i, "]"));
      }
    }
    if (const Json* scene = document_.find("scene")) index(*scene, "scenes", "scene");
    for (std::size_t i = 0; i < count_at(document_, "meshes"); ++i) mesh(i);
    for (std::size_t i = 0; i < count_at(document_, "animations"); ++i) animation(i);
    lights();
    for (std::size_t i = 0; i < count_at(document_, "nodes"); ++i)
      if (const Json* copies =
              find_path(element(document_, "nodes", i), "extensions/EXT_mesh_gpu_instancing"))
        attributes(copies->find("attributes"),
                   text("nodes[", i, "].extensions.EXT_mesh_gpu_instancing.attributes"));
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ExitCode::bad_input, path_, message);
  }

  void check_list(const char* key) const {
    const Json* list = document_.find(key);
    if (!list) return;
    if (!list->is_array()) fail(text(key, " must be an array"));
    for (std::size_t i = 0; i < list->as_array().size(); ++i) {
      if (!list->as_array()[i].is_object()) fail(text(key, "[", i, "] must be an object"));
    }
  }

  void apply(const Rule& rule, const Json& object, const std::string& place) const {
    const Json* value = find_path(object, rule.key);
    const std::string where = place + "." + rule.key;
    if (!value) {
      const std::string by = rule.required_by;
      if (by == "." || (!by.empty() && object.find(by))) fail(where + " is missing");
      return;
    }
    switch (rule.kind) {
      case Kind::index:
        index(*value, rule.target, where);
        break;
      case Kind::indices:
        if (!value->is_array()) fail(where + " must be an array");
        for (const Json& item : value->as_array()) index(item, rule.target, where);
        break;
      case Kind::count:
        whole(*value, 9007199254740992.0, where);
        break;
      case Kind::small_count:
        whole(*value, std::numeric_limits<int>::max(), where);
        break;
      case Kind::number:
        number(*value, where);
        break;
      case Kind::numbers:
        if (!value->is_array()) fail(where + " must be an array of numbers");
        for (const Json& item : value->as_array()) number(item, where);
        if (rule.length && value->as_array().size() != rule.length) {
          fail(text(where, " must have ", rule.length, " numbers, not ", value->as_array().size()));
        }
        break;
      case Kind::text:
        if (!value->is_string()) fail(where + " must be a text");
        break;
      case Kind::boolean:
        if (!value->is_bool()) fail(where + " must be true or false");
        break;
    }
  }

  void number(const Json& value, const std::string& where) const {
    if (!value.is_number() || !std::isfinite(value.as_number())) fail(where + " must be a number");
  }

  double whole(const Json& value, double largest, const std::string& where) const {
    number(value, where);
    const double v = value.as_number();
    if (v != std::floor(v) || v < 0 || v > largest) {
      fail(text(where, " is ", shortest(v), ", which is not a whole number in range"));
    }
    return v;
  }

  void index(const Json& value, const std::string& target, const std::string& where) const {
    const double v = whole(value, std::numeric_limits<int>::max(), where);
    const std::size_t n = count_at(document_, target);
    if (v >= static_cast<double>(n)) {
      fail(text(where, " is ", shortest(v), ", but there are ", n, " ", target));
    }
  }

  void attributes(const Json* map, const std::string& where) const {
    if (!map || !map->is_object()) fail(where + " must be an object");
    for (const auto& [name, accessor] : map->as_object()) index(accessor, "accessors", where + "." + name);
  }

  void mesh(std::size_t m) const {
    const Json* primitives = element(document_, "meshes", m).find("primitives");
    const std::string place = text("meshes[", m, "].primitives");
    if (!primitives || !primitives->is_array()) fail(place + " is missing");
    for (std::size_t p = 0; p < primitives->as_array().size(); ++p) {
      const Json& primitive = primitives->as_array()[p];
      const std::string where = text(place, "[", p, "]");
      if (!primitive.is_object()) fail(where + " must be an object");
      attributes(primitive.find("attributes"), where + ".attributes");
      if (const Json* v = primitive.find("indices")) index(*v, "accessors", where + ".indices");
      if (const Json* v = primitive.find("material")) index(*v, "materials", where + ".material");
      if (const Json* v = primitive.find("mode")) whole(*v, 6, where + ".mode");
      if (const Json* targets = primitive.find("targets")) {
        if (!targets->is_array()) fail(where + ".targets must be an array");
        for (const Json& target : targets->as_array()) attributes(&target, where + ".targets");
      }
    }
  }

  void animation(std::size_t a) const {
    const Json& animation = element(document_, "animations", a);
    const std::string place = text("animations[", a, "]");
    for (const char* key : {"samplers", "channels"}) {
      const Json* list = animation.find(key);
      if (!list || !list->is_array()) fail(place + "." + key + " is missing");
      for (const Json& item : list->as_array()) {
        if (!item.is_object()) fail(place + "." + key + " must hold objects");
      }
    }
    const std::size_t samplers = animation.find("samplers")->as_array().size();
    for (const Json& sampler : animation.find("samplers")->as_array()) {
      for (const char* key : {"input", "output"}) {
        const Json* v = sampler.find(key);
        if (!v) fail(place + ".samplers." + key + " is missing");
        index(*v, "accessors", place + ".samplers." + key);
      }
      apply({"", "interpolation", Kind::text}, sampler, place + ".samplers");
    }
    for (const Json& channel : animation.find("channels")->as_array()) {
      const Json* v = channel.find("sampler");
      if (!v) fail(place + ".channels.sampler is missing");
      if (whole(*v, 1e9, place + ".channels.sampler") >= static_cast<double>(samplers)) {
        fail(text(place, ".channels.sampler is ", shortest(v->as_number()), ", but there are ", samplers));
      }
      apply({"", "target/path", Kind::text, "", 0, "."}, channel, place + ".channels");
      apply({"", "target/node", Kind::index, "nodes"}, channel, place + ".channels");
      apply({"", "target/extensions/KHR_animation_pointer/pointer", Kind::text}, channel,
            place + ".channels");
    }
  }

  void lights() const {
    constexpr const char* kLights = "extensions/KHR_lights_punctual/lights";
    const Json* list = find_path(document_, kLights);
    if (list && !list->is_array()) fail(text(kLights, " must be an array"));
    const std::size_t n = count_at(document_, kLights);
    for (std::size_t i = 0; i < n; ++i) {
      const Json& light = list->as_array()[i];
      const std::string place = text("lights[", i, "]");
      if (!light.is_object()) fail(place + " must be an object");
      apply({"", "type", Kind::text, "", 0, "."}, light, place);
      apply({"", "name", Kind::text}, light, place);
      apply({"", "color", Kind::numbers, "", 3}, light, place);
      apply({"", "intensity", Kind::number}, light, place);
      apply({"", "range", Kind::number}, light, place);
      apply({"", "spot/innerConeAngle", Kind::number}, light, place);
      apply({"", "spot/outerConeAngle", Kind::number}, light, place);
    }
    for (std::size_t i = 0; i < count_at(document_, "nodes"); ++i) {
      const Json* light = find_path(element(document_, "nodes", i), "extensions/KHR_lights_punctual/light");
      if (light && whole(*light, 1e9, text("nodes[", i, "].light")) >= static_cast<double>(n)) {
        fail(
            text("nodes[", i, "].light is ", shortest(light->as_number()), ", but there are ", n, " lights"));
      }
    }
  }

  const Json& document_;
  const std::string& path_;
};

}  // namespace

void check_gltf(const Json& document, const std::string& path) {
  Checker(document, path).check();
  check_gltf_luminaires(document, path);
}

}  // namespace phos::inline scene
