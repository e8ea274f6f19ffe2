// Solid glass, n = 1.5, that absorbs nothing.
#pragma once

#include "support/scenes.h"

namespace phos::test {

inline std::uint32_t add_solid_glass(Scene& scene) {
  const std::uint32_t glass = add_lambert(scene, "glass", 0);
  scene.material[glass].model = Model::dielectric, scene.material[glass].ior = 1.5f;
  return glass;
}

/// Six faces, fronts outside, of the instance begun last.
inline void add_block(Scene& scene, const Vec3& lo, const Vec3& hi) {
  const Vec3 d = hi - lo, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  add_quad(scene, lo, x, z), add_quad(scene, lo + y, z, x);
  add_quad(scene, lo, z, y), add_quad(scene, lo + x, y, z);
  add_quad(scene, lo, y, x), add_quad(scene, lo + z, x, y);
}

/// A ball of 2 x rings^2 pieces with smooth normals, fronts outside, of the instance begun last.
inline void add_smooth_ball(Scene& scene, const Vec3& centre, float radius_m, int rings = 24) {
  const int slices = 2 * rings;
  const auto at = [&](int ring, int slice) {
    const double polar = std::numbers::pi * ring / rings, around = 2 * std::numbers::pi * slice / slices;
    return Vec3(std::sin(polar) * std::cos(around), std::cos(polar), std::sin(polar) * std::sin(around));
  };
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    if (glm::length(glm::cross(b - a, c - a)) < 1e-6f) return;
    add_triangle(scene, centre + radius_m * a, centre + radius_m * b, centre + radius_m * c);
    const std::size_t last = scene.normal.size();
    scene.normal[last - 3] = a, scene.normal[last - 2] = b, scene.normal[last - 1] = c;
  };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < slices; ++s) {
      add(at(r, s), at(r + 1, s + 1), at(r + 1, s));
      add(at(r, s), at(r, s + 1), at(r + 1, s + 1));
    }
}

}  // namespace phos::test
