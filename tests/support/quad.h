// A rectangle in the plane z = height, made by hand.
#pragma once

#include "scene/scene.h"

namespace phos::test {

/// Adds two triangles over [-a,a] x [-b,b] as an instance of a material; `up` tells the side of their front.
/// Texture coordinates show the picture upright to an eye at y = -infinity that looks at the front of a quad
/// that faces up.
inline std::uint32_t add_quad(Scene& scene, float a, float b, float z, bool up, std::uint32_t material) {
  const auto base = static_cast<std::uint32_t>(scene.position.size());
  const Vec3 corner[4] = {{-a, -b, z}, {a, -b, z}, {a, b, z}, {-a, b, z}};
  const Vec2 uv[4] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  for (int i = 0; i < 4; ++i) {
    scene.position.push_back(corner[i]);
    scene.normal.push_back(Vec3(0, 0, up ? 1 : -1));
    scene.uv0.push_back(uv[i]);
  }
  Instance instance;
  instance.material = material;
  instance.first_triangle = static_cast<std::uint32_t>(scene.triangle.size());
  instance.triangle_count = 2;
  for (int t = 0; t < 2; ++t) {
    const auto p = base + (t == 0 ? 1u : 2u), q = base + (t == 0 ? 2u : 3u);
    scene.triangle.push_back({{base, up ? p : q, up ? q : p}});
    scene.triangle_instance.push_back(static_cast<std::uint32_t>(scene.instance.size()));
  }
  scene.instance.push_back(instance);
  return static_cast<std::uint32_t>(scene.instance.size() - 1);
}

/// The same as an area light of a new material.
inline void add_lamp(Scene& scene, float a, float b, float z, bool up, const Rgb& luminance_cd_m2) {
  Material material;
  material.emission = luminance_cd_m2;
  scene.material.push_back(material);
  Light light;
  light.kind = Light::Kind::area;
  light.instance = add_quad(scene, a, b, z, up, static_cast<std::uint32_t>(scene.material.size() - 1));
  light.area_m2 = 4 * a * b;
  light.flux_lm = kPi * light.area_m2 * luminance_cd_m2;
  scene.light.push_back(light);
}

}  // namespace phos::test
