// Makes small glTF files for tests.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/json.h"

namespace phos::test {

/// Binary glTF: header, JSON chunk, and a binary chunk if there are bytes.
inline std::string glb(std::string json, std::string bin) {
  while (json.size() % 4) json += ' ';
  while (bin.size() % 4) bin += '\0';
  const auto word = [](std::size_t v) {
    const auto n = static_cast<std::uint32_t>(v);
    std::string s(4, '\0');
    std::memcpy(s.data(), &n, 4);
    return s;
  };
  const std::size_t size = 12 + 8 + json.size() + (bin.empty() ? 0 : 8 + bin.size());
  std::string out = "glTF" + word(2) + word(size) + word(json.size()) + "JSON" + json;
  if (!bin.empty()) out += word(bin.size()) + std::string("BIN\0", 4) + bin;
  return out;
}

/// A document under construction; `json` may be edited freely before bytes().
struct Gltf {
  Json json;
  std::string bin;

  Gltf() {
    json["asset"]["version"] = "2.0";
    json["scene"] = 0;
    Json scene;
    scene["nodes"] = Json::Array{};
    json["scenes"].push_back(scene);
  }

  std::size_t size(const char* list) const {
    return json.find(list) ? json.find(list)->as_array().size() : 0;
  }

  template <class T>
  int view(const std::vector<T>& values) {
    while (bin.size() % 4) bin += '\0';
    Json v;
    v["buffer"] = 0;
    v["byteOffset"] = bin.size();
    v["byteLength"] = values.size() * sizeof(T);
    bin.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    json["bufferViews"].push_back(v);
    return static_cast<int>(size("bufferViews")) - 1;
  }

  template <class T>
  int accessor(const std::vector<T>& values, const char* type, int components, int component_type,
               bool normalized = false) {
    Json a;
    a["bufferView"] = view(values);
    a["componentType"] = component_type;
    a["count"] = values.size() / static_cast<std::size_t>(components);
    a["type"] = type;
    if (normalized) a["normalized"] = true;
    json["accessors"].push_back(a);
    return static_cast<int>(size("accessors")) - 1;
  }
  int vec3(const std::vector<float>& v) { return accessor(v, "VEC3", 3, 5126); }
  int vec2(const std::vector<float>& v) { return accessor(v, "VEC2", 2, 5126); }
  int scalars(const std::vector<float>& v) { return accessor(v, "SCALAR", 1, 5126); }
  int indices(const std::vector<std::uint16_t>& v) { return accessor(v, "SCALAR", 1, 5123); }

  /// A mesh of one primitive.
  int mesh(Json primitive) {
    Json m;
    m["name"] = "mesh";
    m["primitives"].push_back(std::move(primitive));
    json["meshes"].push_back(m);
    return static_cast<int>(size("meshes")) - 1;
  }
  int material(Json m) {
    json["materials"].push_back(std::move(m));
    return static_cast<int>(size("materials")) - 1;
  }
  /// A root node.
  int node(Json n) {
    const int index = static_cast<int>(size("nodes"));
    json["nodes"].push_back(std::move(n));
    Json scene = json.find("scenes")->as_array()[0];
    scene["nodes"].push_back(index);
    json["scenes"] = Json::Array{scene};
    return index;
  }
  /// The unit square in z = 0, two triangles, seen from +z.
  Json square() {
    Json p;
    p["attributes"]["POSITION"] = vec3({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    p["attributes"]["NORMAL"] = vec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    p["attributes"]["TEXCOORD_0"] = vec2({0, 0, 1, 0, 1, 1, 0, 1});
    p["indices"] = indices({0, 1, 2, 0, 2, 3});
    return p;
  }
  int square_node(const Json& material_or_null = Json()) {
    Json p = square();
    if (!material_or_null.is_null()) p["material"] = material(material_or_null);
    Json n;
    n["mesh"] = mesh(p);
    n["name"] = "square";
    return node(n);
  }

  std::string bytes() const {
    Json copy = json;
    if (!bin.empty()) {
      Json buffer;
      buffer["byteLength"] = bin.size();
      copy["buffers"] = Json::Array{buffer};
    }
    return glb(copy.dump(), bin);
  }
};

}  // namespace phos::test
