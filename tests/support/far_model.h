// A small lit scene anywhere in the world.
#pragma once

#include <string>
#include <vector>

#include "core/vector.h"
#include "support/gltf.h"

namespace phos::test {

inline Json triple(const DVec3& v) { return Json::Array{v.x, v.y, v.z}; }

/// A floor of 1 m about its node's origin, a wall behind it, a lamp above and a camera, all below a node at
/// `site`; with `moving`, a film in which the floor slides. `in_vertices`: the floor alone, its vertices off
/// in place of the node.
inline std::string model_at(const DVec3& site, bool moving = false, bool in_vertices = false) {
  Gltf g;
  Json floor;
  std::vector<float> corner{-0.5f, 0, -0.5f, -0.5f, 0, 0.5f, 0.5f, 0, 0.5f, 0.5f, 0, -0.5f};
  if (in_vertices)
    for (std::size_t i = 0; i < corner.size(); ++i)
      corner[i] += static_cast<float>(site[static_cast<int>(i % 3)]);
  floor["attributes"]["POSITION"] = g.vec3(corner);
  floor["indices"] = g.indices({0, 1, 2, 0, 2, 3});
  const int mesh = g.mesh(floor);
  Json lights, lamp;
  lamp["type"] = "point", lamp["intensity"] = 100;
  lights["lights"] = Json::Array{lamp};
  g.json["extensions"]["KHR_lights_punctual"] = lights;
  g.json["extensionsUsed"] = Json::Array{"KHR_lights_punctual"};
  Json perspective, camera;
  perspective["yfov"] = 1, perspective["znear"] = 0.1;
  camera["type"] = "perspective", camera["perspective"] = perspective;
  g.json["cameras"] = Json::Array{camera};

  Json site_node, floor_node, lamp_node, camera_node;
  const DVec3 root = in_vertices ? DVec3(0) : site, off = in_vertices ? site : DVec3(0);
  site_node["translation"] = triple(root);
  site_node["children"] = in_vertices ? Json::Array{1, 2, 3} : Json::Array{1, 2, 3, 4};
  site_node["name"] = "site";
  floor_node["mesh"] = mesh, floor_node["name"] = "floor";
  lamp_node["translation"] = triple(off + DVec3(0.125, 0.5, 0)), lamp_node["name"] = "lamp";
  lamp_node["extensions"]["KHR_lights_punctual"]["light"] = 0;
  camera_node["translation"] = triple(off + DVec3(0, 0.5, 1)), camera_node["camera"] = 0;
  g.node(site_node);
  for (const Json& n : {floor_node, lamp_node, camera_node}) g.json["nodes"].push_back(n);
  if (!in_vertices) {
    Json wall, wall_node;
    wall["attributes"]["POSITION"] = g.vec3({-0.5f, 0, 0, 0.5f, 0, 0, 0.5f, 1, 0, -0.5f, 1, 0});
    wall["indices"] = g.indices({0, 1, 2, 0, 2, 3});
    wall_node["mesh"] = g.mesh(wall), wall_node["name"] = "wall";
    wall_node["translation"] = triple(DVec3(0, 0, -0.5));
    g.json["nodes"].push_back(wall_node);
  }
  if (moving) {
    Json sampler, channel, animation;
    sampler["input"] = g.scalars({0, 1});
    sampler["output"] = g.vec3({0, 0, 0, 0.25f, 0, 0});
    channel["sampler"] = 0, channel["target"]["node"] = 1, channel["target"]["path"] = "translation";
    animation["samplers"] = Json::Array{sampler}, animation["channels"] = Json::Array{channel};
    g.json["animations"] = Json::Array{animation};
  }
  return g.bytes();
}

}  // namespace phos::test
