// A room with a pane, a mirror on the wall and a mirror ball, on request.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "support/gltf.h"
#include "support/run.h"

namespace phos::test {

struct ShinyRoom {
  bool pane = false;    ///< tinted, between the lamp and the back wall
  bool mirror = false;  ///< the left wall
  bool ball = false;    ///< a mirror on the floor
};

/// Writes a room of 2 x 2 x 2 m, open before its camera, with a box and a point lamp in it. Returns the path.
inline std::string shiny_room(const std::string& path, const ShinyRoom& with) {
  Gltf g;
  const auto material = [&](const char* name, const char* brdf, const std::vector<double>& colour,
                            const char* key) {
    Json m;
    m["name"] = name;
    m["doubleSided"] = true;
    m["pbrMetallicRoughness"]["metallicFactor"] = 0;
    m["extras"]["phos"]["brdf"] = brdf;
    if (*key)
      for (const double c : colour) m["extras"]["phos"][key].push_back(c);
    return m;
  };
  const auto add = [&](const std::vector<float>& corners, const std::vector<float>& normals,
                       const std::vector<std::uint16_t>& indices, const Json& of) {
    Json p, node;
    p["attributes"]["POSITION"] = g.vec3(corners);
    if (!normals.empty()) p["attributes"]["NORMAL"] = g.vec3(normals);
    p["indices"] = g.indices(indices);
    p["material"] = g.material(of);
    node["mesh"] = g.mesh(p);
    g.node(node);
  };
  const std::vector<std::uint16_t> quad{0, 1, 2, 0, 2, 3};
  const auto matt = [&](const char* name, const std::vector<double>& kd) {
    return material(name, "lambert", kd, "kd");
  };
  add({-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1}, {}, quad, matt("floor", {0.5, 0.5, 0.45}));
  add({-1, 2, -1, 1, 2, -1, 1, 2, 1, -1, 2, 1}, {}, quad, matt("ceiling", {0.6, 0.6, 0.6}));
  add({-1, 0, -1, 1, 0, -1, 1, 2, -1, -1, 2, -1}, {}, quad, matt("back", {0.7, 0.7, 0.7}));
  add({1, 0, -1, 1, 0, 1, 1, 2, 1, 1, 2, -1}, {}, quad, matt("right", {0.2, 0.5, 0.15}));
  add({-1, 0, 1, -1, 0, -1, -1, 2, -1, -1, 2, 1}, {}, quad,
      with.mirror ? material("left", "mirror", {0.9, 0.9, 0.9}, "ks") : matt("left", {0.6, 0.15, 0.1}));
  std::vector<float> box;
  for (int k = 0; k < 8; ++k)
    for (const auto& [c, middle, half] : {std::tuple(0, 0.4f, 0.25f), {1, 0.4f, 0.4f}, {2, -0.4f, 0.25f}})
      box.push_back(middle + (k >> c & 1 ? half : -half));
  add(box, {}, {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6},
      matt("box", {0.7, 0.6, 0.3}));
  if (with.pane) {
    Json pane = material("pane", "thindielectric", {}, "");
    pane["extras"]["phos"]["ior"] = 1.5, pane["extras"]["phos"]["transmittance"] = 0.5;
    add({-0.95f, 0.1f, 0.3f, 0.7f, 0.1f, 0.3f, 0.7f, 1.9f, 0.3f, -0.95f, 1.9f, 0.3f}, {}, quad, pane);
  }
  if (with.ball) {
    constexpr int kAround = 64, kDown = 32;
    std::vector<float> corners, normals;
    std::vector<std::uint16_t> faces;
    for (int j = 0; j <= kDown; ++j)
      for (int i = 0; i <= kAround; ++i) {
        const float t = 3.14159265f * static_cast<float>(j) / kDown,
                    f = 6.2831853f * static_cast<float>(i) / kAround;
        const float n[3] = {std::sin(t) * std::cos(f), std::cos(t), std::sin(t) * std::sin(f)};
        const float middle[3] = {-0.45f, 0.31f, 0.45f};
        for (int c = 0; c < 3; ++c) normals.push_back(n[c]), corners.push_back(middle[c] + 0.3f * n[c]);
        if (j == kDown || i == kAround) continue;
        const int at = j * (kAround + 1) + i, below = at + kAround + 1;
        for (const int k : {at, at + 1, below, below, at + 1, below + 1})
          faces.push_back(static_cast<std::uint16_t>(k));
      }
    add(corners, normals, faces, material("ball", "mirror", {0.8, 0.8, 0.8}, "ks"));
  }
  Json lamp, light, camera, view;
  light["type"] = "point", light["name"] = "lamp", light["intensity"] = 100;
  g.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(light);
  g.json["extensionsUsed"].push_back("KHR_lights_punctual");
  for (const double x : {0.3, 1.7, 0.6}) lamp["translation"].push_back(x);
  lamp["extensions"]["KHR_lights_punctual"]["light"] = 0;
  g.node(lamp);
  view["type"] = "perspective", view["perspective"]["yfov"] = 0.65, view["perspective"]["znear"] = 0.01;
  g.json["cameras"].push_back(view);
  for (const double x : {0.1, 1.0, 3.9}) camera["translation"].push_back(x);
  camera["camera"] = 0;
  g.node(camera);
  spill(path, g.bytes());
  return path;
}

}  // namespace phos::test
