// A scene as the page draws it.
#pragma once

#include <cstddef>
#include <string>

#include "scene/scene.h"
#include "view/limits.h"

namespace phos::inline view {

/// MessageKind::scene. Materials become their diffuse reflectance, the mean reflectance of their gloss, and
/// the shares of light that they reflect as a mirror and let through. Materials that pass more light than
/// they reflect are clear. Maps of normals, roughness and transmission are left out. Area lamps become up to
/// `light_samples` places each, fewer where the scene has many lamps; an environment has four times as many.
/// Textures of more than `most_texels` together are made smaller. Throws Error(usage) for a scene beyond
/// kMostPageBytes.
std::string scene_message(const Scene& scene, int light_samples,
                          std::size_t most_texels = kMostPageTexels.as<std::size_t>());

}  // namespace phos::inline view
