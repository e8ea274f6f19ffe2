// A pane over a floor.
#pragma once

#include "support/scenes.h"

namespace phos::test {

constexpr double kClear = 0.92307692;  // transmittance of a pane at normal incidence, n = 1.5
constexpr double kAt30 = 0.920734444;  // at 30 degrees: mean of both polarisations

/// Clear, thin, n = 1.5.
inline std::uint32_t add_pane(Scene& scene) {
  const std::uint32_t glass = add_lambert(scene, "glass", 0);
  scene.material[glass].model = Model::thin_dielectric;
  return glass;
}

/// A floor of 40 x 40 m at y = 0 and a pane as large over it. finalize() is left to be called.
inline Scene under_a_pane(float pane_m, float albedo = 0) {
  Scene scene;
  begin_instance(scene, "floor", add_lambert(scene, "floor", albedo));
  add_quad(scene, {-20, 0, -20}, {0, 0, 40}, {40, 0, 0});
  begin_instance(scene, "pane", add_pane(scene));
  add_quad(scene, {-20, pane_m, -20}, {0, 0, 40}, {40, 0, 0});
  return scene;
}

}  // namespace phos::test
