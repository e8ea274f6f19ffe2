// Makes small animated glTF files for tests: eight frames a second, so that the time of every frame is exact.
#pragma once

#include <string>
#include <vector>

#include "support/gltf.h"
#include "support/run.h"

namespace phos::test {

struct Animated : Gltf {
  static constexpr double kFps = 8;

  /// One animation of one channel; `frame` are the keys' frames, `path` a node's property.
  void animate(int node, const std::string& path, const std::vector<float>& frame,
               const std::vector<float>& values, const std::string& interpolation = "LINEAR") {
    Json target;
    target["node"] = node;
    target["path"] = path;
    add(target, frame, values, path == "rotation" ? 4 : path == "weights" ? 1 : 3, interpolation);
  }
  /// The same of a number, or a colour, by its JSON pointer.
  void animate(const std::string& pointer, const std::vector<float>& frame, const std::vector<float>& values,
               const std::string& interpolation = "LINEAR") {
    Json target;
    target["path"] = "pointer";
    target["extensions"]["KHR_animation_pointer"]["pointer"] = pointer;
    add(target, frame, values, values.size() > frame.size() ? 3 : 1, interpolation);
  }

  /// A horizontal square of this side about a place, facing up (or down), as a node of its own.
  int slab(const std::string& name, float side, float x, float y, float z, const Json& material = Json()) {
    Json p;
    const float h = side / 2;
    p["attributes"]["POSITION"] = vec3({-h, 0, h, h, 0, h, h, 0, -h, -h, 0, -h});
    p["attributes"]["NORMAL"] = vec3({0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0});
    p["indices"] = indices({0, 1, 2, 0, 2, 3});
    if (!material.is_null()) p["material"] = this->material(material);
    Json n;
    n["mesh"] = mesh(p);
    n["name"] = name;
    n["translation"] = Json::Array{x, y, z};
    return node(n);
  }
  static Json glow(float cd_m2) {
    Json m;
    m["name"] = "glow";
    m["emissiveFactor"] = Json::Array{1, 1, 1};
    m["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = cd_m2;
    return m;
  }
  /// Adds a punctual light, whose number is the number of the call, and its node.
  int lamp(const std::string& name, const std::string& type, float intensity, float x, float y, float z) {
    Json light, n;
    light["type"] = type;
    light["intensity"] = intensity;
    json["extensions"]["KHR_lights_punctual"]["lights"].push_back(light);
    n["name"] = name;
    n["translation"] = Json::Array{x, y, z};
    n["extensions"]["KHR_lights_punctual"]["light"] = lamps_++;
    return node(n);
  }
  int camera(const std::string& name) {
    Json c, n;
    c["type"] = "perspective";
    c["perspective"]["yfov"] = 0.8;
    c["perspective"]["znear"] = 0.1;
    json["cameras"].push_back(c);
    n["name"] = name;
    n["camera"] = static_cast<int>(size("cameras")) - 1;
    return node(n);
  }

  /// Writes the file, with so many frames.
  std::string write(const std::string& name, int frames) {
    Json scene = json.find("scenes")->as_array()[0];
    scene["extras"]["animation"]["fps"] = kFps;
    scene["extras"]["animation"]["frames"] = frames;
    json["scenes"] = Json::Array{scene};
    const std::string path = scratch(name) + "/" + name + ".glb";
    spill(path, bytes());
    return path;
  }

 private:
  void add(const Json& target, std::vector<float> frame, const std::vector<float>& values, int width,
           const std::string& interpolation) {
    for (float& f : frame) f /= static_cast<float>(kFps);
    Json sampler, channel, animation;
    sampler["input"] = scalars(frame);
    const char* const type = width == 4 ? "VEC4" : width == 3 ? "VEC3" : "SCALAR";
    sampler["output"] = accessor(values, type, width, 5126);
    sampler["interpolation"] = interpolation;
    channel["sampler"] = 0;
    channel["target"] = target;
    animation["samplers"] = Json::Array{sampler};
    animation["channels"] = Json::Array{channel};
    json["animations"].push_back(animation);
  }
  int lamps_ = 0;
};

}  // namespace phos::test
