// Environment maps made in code, and scenes without walls to put into them.
#pragma once

#include <memory>

#include "scene/sky/environment.h"
#include "support/scenes.h"

namespace phos::test {

/// Twice as wide as high; texel(column, row) gives cd/m2.
template <class Texel>
Environment map_of(int height, const Texel& texel, double rotation_rad = 0) {
  std::vector<Rgb> texels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < 2 * height; ++x) texels.push_back(texel(x, y));
  return {2 * height, height, std::move(texels), rotation_rad};
}

inline Environment constant_map(int height, const Rgb& luminance_cd_m2, double rotation_rad = 0) {
  return map_of(
      height, [&](int, int) { return luminance_cd_m2; }, rotation_rad);
}

/// A smooth coloured one, bright towards one side, black at the bottom.
inline Environment gradient_map(int height, double rotation_rad = 0) {
  return map_of(
      height,
      [&](int x, int y) {
        const float turn = static_cast<float>(x) / static_cast<float>(2 * height);
        const float up = 1 - static_cast<float>(y) / static_cast<float>(height - 1);
        return up * Rgb(1 + std::cos(2 * kPi * turn), 1, 0.5f + up);
      },
      rotation_rad);
}

/// A square floor at y = 0, facing up.
inline Scene open_floor(float half_side_m = 1, float albedo = 0.5f) {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "grey", albedo));
  const float a = half_side_m;
  add_quad(scene, {-a, 0, -a}, {0, 0, 2 * a}, {2 * a, 0, 0});
  return scene;
}

/// Puts the scene into an environment and finalizes it.
inline void surround(Scene& scene, const Environment& environment) {
  scene.environment = std::make_shared<const Environment>(environment);
  finalize(scene);
}

}  // namespace phos::test
