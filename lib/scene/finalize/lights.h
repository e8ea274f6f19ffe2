// The lights of a scene: area, flux, and lamps of emitting surfaces.
#pragma once

#include "scene/scene.h"

namespace phos::inline scene {

/// What scene.warnings say of a light too faint for floats beside others; where the brightest is, the scene
/// is refused.
inline constexpr const char* kFaintLight = "too little for 32-bit numbers, some of it may be lost";

/// Replaces the area lights by one per emitting instance, and fills area and flux of every light. Needs
/// bounds.
void fill_lights(Scene& scene);

/// Mean luminance over a triangle, the emissive texture included, cd/m2.
Rgb mean_emission(const Scene& scene, std::uint32_t triangle);

}  // namespace phos::inline scene
