#include "scene/gltf/findings.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <tuple>

#include "core/error.h"
#include "scene/gltf/document.h"
#include "scene/report/features.h"

namespace phos::inline scene {
namespace {

struct List {
  const char *key, *kind;
};
constexpr List kLists[] = {
    {"nodes", "node"},
    {"meshes", "mesh"},
    {"materials", "material"},
    {"textures", "texture"},
    {"images", "image"},
    {"samplers", "sampler"},
    {"cameras", "camera"},
    {"skins", "skin"},
    {"animations", "animation"},
    {"accessors", "accessor"},
    {"bufferViews", "buffer view"},
    {"buffers", "buffer"},
    {"scenes", "scene"},
};

bool is_zero(const Json& value) {
  if (value.is_number()) return value.as_number() == 0;
  if (!value.is_array()) return value.is_null();
  return std::all_of(value.as_array().begin(), value.as_array().end(), is_zero);
}

/// Is one of the members there, and not 0?
bool says_any(const Json& object, std::string_view members) {
  while (!members.empty()) {
    const std::size_t end = std::min(members.find(','), members.size());
    const Json* value = object.find(std::string(members.substr(0, end)));
    if (value && !is_zero(*value)) return true;
    members.remove_prefix(std::min(end + 1, members.size()));
  }
  return false;
}

class Finder {
 public:
  explicit Finder(const Json& document) : document_(document) {}

  std::vector<Note> find() {
    for (const List& list : kLists) {
      for (std::size_t i = 0; i < count_at(document_, list.key); ++i) {
        const Json& object = element(document_, list.key, i);
        const Json* name = object.find("name");
        kind_ = list.kind;
        name_ =
            name && name->is_string() && !name->as_string().empty() ? name->as_string() : std::to_string(i);
        exact_ = find_path(object, "extras/phos/brdf") != nullptr;
        walk(object);
        properties(object);
      }
    }
    kind_.clear(), name_.clear();
    exact_ = false;
    of_document();
    lights();
    return std::move(notes_);
  }

 private:
  void add(Note::Level level, const std::string& message) {
    if (known_.emplace(kind_, name_, message).second)
      notes_.emplace_back(level, kExtension, kind_, name_, message);
  }

  /// Everything inside of one object.
  void walk(const Json& json) {
    if (json.is_array()) {
      for (const Json& item : json.as_array()) walk(item);
      return;
    }
    if (!json.is_object()) return;
    for (const auto& [key, value] : json.as_object()) {
      if (key == "extras") continue;
      if (key == "extensions" && value.is_object())
        for (const auto& [name, extension] : value.as_object()) found(name, extension);
      walk(value);
    }
  }

  void found(const std::string& name, const Json& extension) {
    used_.insert(name);
    const Feature* feature = find_extension(name);
    if (!feature) return add(Note::Level::warning, name + " is not known, and is ignored");
    if (feature->state != Feature::State::told && feature->state != Feature::State::in_part) return;
    if (exact_ && name.starts_with("KHR_materials_")) return;  // extras.phos is the exact model
    if (feature->when == "-" || (!feature->when.empty() && !says_any(extension, feature->when))) return;
    add(feature->level, told(*feature));
  }

  void properties(const Json& object) {
    if (object.find("occlusionTexture"))
      add(Note::Level::info, "occlusionTexture is not used: how surfaces hide each other is computed");
    if (kind_ != "mesh") return;
    for (const Json& primitive : object.find("primitives")->as_array()) {
      for (const auto& [name, accessor] : primitive.find("attributes")->as_object()) {
        if (name == "JOINTS_1")
          add(Note::Level::warning, "JOINTS_1 is ignored: four joints move a vertex at most");
        if (name == "COLOR_1")
          add(Note::Level::info, "COLOR_1 is ignored: what it means is the application's");
      }
      const Json* position = primitive.find("attributes")->find("POSITION");
      if (find_path(primitive, "extensions/KHR_draco_mesh_compression") && position &&
          !element(document_, "accessors", static_cast<std::size_t>(position->as_number()))
               .find("bufferView"))
        add(Note::Level::warning,
            "KHR_draco_mesh_compression is all there is of it, and is not read: the mesh is left out");
      const Json* targets = primitive.find("targets");
      if (!targets) continue;
      for (const Json& target : targets->as_array())
        for (const auto& [name, accessor] : target.as_object())
          if (name.starts_with("TEXCOORD_") || name.starts_with("COLOR_"))
            add(Note::Level::warning, "morph targets of " + name + " are ignored: they do not move");
    }
  }

  void of_document() {
    if (const Json* own = document_.find("extensions"); own && own->is_object()) {
      for (const auto& [name, extension] : own->as_object()) {
        found(name, extension);
        walk(extension);
      }
    }
    if (const std::size_t n = count_at(document_, "scenes"); n > 1)
      add(Note::Level::info, text("one of ", n, " scenes is read, the default one"));
    const Json* listed = document_.find("extensionsUsed");
    if (!listed || !listed->is_array()) return;
    for (const Json& name : listed->as_array()) {
      if (!name.is_string() || used_.contains(name.as_string())) continue;
      if (!find_extension(name.as_string()))
        add(Note::Level::info, name.as_string() + " is not known, and nothing uses it");
    }
  }

  void lights() {
    const Json* list = find_path(document_, "extensions/KHR_lights_punctual/lights");
    if (!list) return;
    for (std::size_t i = 0; i < list->as_array().size(); ++i) {
      const Json& light = list->as_array()[i];
      const Json* range = light.find("range");
      if (!range || is_zero(*range) || text_at(light, "type", "") == "directional") continue;
      kind_ = "light", name_ = text_at(light, "name", std::to_string(i));
      add(Note::Level::warning, text("range ", find_extension("KHR_lights_punctual range")->sentence));
    }
  }

  const Json& document_;
  std::vector<Note> notes_;
  std::set<std::tuple<std::string, std::string, std::string>> known_;
  std::set<std::string> used_;  // extensions
  std::string kind_, name_;     // of the object that is walked through
  bool exact_ = false;
};

std::string lower(std::string s) {
  for (char& c : s) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

bool sounds_metallic(const std::string& name) {
  constexpr std::array kWords = {"metal", "steel",   "stahl",  "iron",   "eisen",   "alumin",
                                 "chrom", "gold",    "silver", "silber", "copper",  "kupfer",
                                 "brass", "messing", "bronze", "zinc",   "zink",    "nickel",
                                 "titan", "platin",  "inox",   "mirror", "spiegel", "tin_"};
  const std::string l = lower(name);
  return std::any_of(kWords.begin(), kWords.end(),
                     [&](const char* w) { return l.find(w) != std::string::npos; });
}

/// Exporters that write no factor of glTF's default value.
constexpr const char* kTidy[] = {"blender", "gltf-transform", "gltfpack", "gltf tools for unity"};

/// Writes no factor that has glTF's default value, so that its absence is a statement.
bool leaves_defaults_out(const Json& document) {
  const Json* generator = find_path(document, "asset/generator");
  if (!generator || !generator->is_string()) return false;
  const std::string name = lower(generator->as_string());
  return std::any_of(std::begin(kTidy), std::end(kTidy),
                     [&](const char* w) { return name.find(w) != std::string::npos; });
}

bool likely_paint(const Json& material) {
  const Json* name = material.find("name");
  if (name && name->is_string() && sounds_metallic(name->as_string())) return false;
  for (const char* other :
       {"pbrMetallicRoughness/metallicFactor", "pbrMetallicRoughness/metallicRoughnessTexture",
        "extras/phos/brdf", "extensions/KHR_materials_unlit", "extensions/KHR_materials_transmission",
        "extensions/KHR_materials_pbrSpecularGlossiness"})
    if (find_path(material, other)) return false;
  if (const Json* emission = material.find("emissiveFactor"); emission && !is_zero(*emission)) return false;
  const Json* base = find_path(material, "pbrMetallicRoughness/baseColorFactor");
  if (!base) return true;
  const Json::Array& c = base->as_array();
  return c[0].as_number() > 0 || c[1].as_number() > 0 || c[2].as_number() > 0;
}

}  // namespace

std::vector<Note> gltf_findings(const Json& document) { return Finder(document).find(); }

std::vector<Note> metals_by_default(const Json& document) {
  std::vector<Note> notes;
  if (leaves_defaults_out(document)) return notes;
  for (std::size_t i = 0; i < count_at(document, "materials"); ++i) {
    const Json& material = element(document, "materials", i);
    if (likely_paint(material))
      notes.emplace_back(Note::Level::warning, kMetalByDefault, "material",
                         text_at(material, "name", text("material ", i)),
                         "no metallicFactor is stated, which means metal; paint should state 0");
  }
  return notes;
}

}  // namespace phos::inline scene
