// Where the light of a sky gets in.
#pragma once

#include <optional>
#include <string>

#include "scene/rays.h"

namespace phos::inline scene {

/// Does a ray leave the scene, straight through glass, to where there is light?
bool sees_sky(const RayScene& rays, const Ray& ray);

/// In a scene with an environment: a line for people if no camera of the scene gets any of its light, on up
/// to eight bounces, through glass or off walls. Nothing where light was found, or where there is no camera
/// or environment. Tried with 4096 paths: an opening that lets in less than about a thousandth of the visible
/// light may be missed.
std::optional<std::string> closed_to_the_sky(const RayScene& rays);

}  // namespace phos::inline scene
