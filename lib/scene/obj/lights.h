// Lights and cameras of an OBJ scene, which Wavefront files cannot hold.
#pragma once

#include <string>

#include "scene/luminaire/hang.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// "room.obj" -> "room.lights.json".
std::string obj_lights_path(const std::string& obj_path);

/// Adds the lights and cameras of <name>.lights.json, if that file is there. It is an object of two arrays,
/// both optional:
///   "lights":  [{"name", "kind": "point"|"spot"|"directional", "position": [m], "direction": [3],
///                "intensity": number or RGB (cd; directional: lx), "inner_deg", "outer_deg": half angles of
///                a spot, at most 90; equal ones are a hard edge}]
///   "cameras": [{"name", "eye": [m], "target": [m], "up": [3] (0,1,0), "yfov_deg": 45, "aspect": 1}]
/// Surfaces that shine are materials with Ke, in cd/m2. Lights that `given` names become its luminaires.
/// Throws Error(bad_input) naming the entry.
void read_obj_lights(const std::string& obj_path, GivenLuminaires& given, LuminairesAs as, Scene& scene);

}  // namespace phos::inline scene
