// A scene as the page draws it.
#pragma once

#include <cstddef>
#include <string>

#include "scene/scene.h"
#include "view/scene_textures.h"

namespace phos::inline view {

struct SceneMessage {
  std::string bytes;                 ///< MessageKind::scene
  std::size_t reduced_textures = 0;  ///< that have fewer texels than in the scene
};

/// Materials become their diffuse reflectance, the mean reflectance of their gloss, and
/// the shares of light that they reflect as a mirror and let through. Materials that pass more light than
/// they reflect are clear. Maps of normals, roughness and transmission are left out. Area lamps become up to
/// `light_samples` places each, fewer where the scene has many lamps; an environment has four times as many.
/// Textures become as small as `most` says. Throws Error(usage) for a scene beyond kMostPageBytes.
SceneMessage scene_message(const Scene& scene, int light_samples, const TextureLimits& most = {});

}  // namespace phos::inline view
