// Black rooms with a mirror wall, whose light is known by the image of the lamp.
#pragma once

#include "support/scenes.h"

namespace phos::test {

/// A level normal map: a mirror that has one is no plane in which lamps have images, so that rays and photons
/// tell of its light.
inline void hide_images(Scene& scene, Material& material) {
  material.normal.texture = static_cast<std::int32_t>(scene.texture.size());
  Texture level;
  level.name = "level", level.width = level.height = 1;
  level.texels = {Vec4(0.5f, 0.5f, 1, 1)};
  scene.texture.push_back(level);
}

/// One without images.
inline std::uint32_t add_mirror(Scene& scene, const std::string& name, float reflectance) {
  Material m;
  m.name = name;
  m.model = Model::mirror;
  m.ks = Rgb(reflectance);
  hide_images(scene, m);
  scene.material.push_back(m);
  return static_cast<std::uint32_t>(scene.material.size() - 1);
}

/// A black box 0..4 x 0..3 x 0..5 m with a mirror at x = 4 and a point lamp. What does not come straight
/// comes from the image of the lamp at 8 - x: E = rho I cos / d2, on any plane in the room.
struct MirrorBox {
  static constexpr float kReflectance = 0.8f, kIntensity_cd = 1000;
  inline static const Vec3 kLamp{1.5f, 2, 2.5f};
  Scene scene;

  MirrorBox() {
    const Vec3 hi(4, 3, 5), x(hi.x, 0, 0), y(0, hi.y, 0), z(0, 0, hi.z), lo(0);
    begin_instance(scene, "walls", add_lambert(scene, "black", 0));
    add_quad(scene, lo, z, x), add_quad(scene, lo + y, x, z), add_quad(scene, lo, y, z);
    add_quad(scene, lo, x, y), add_quad(scene, lo + z, y, x);
    begin_instance(scene, "mirror", add_mirror(scene, "mirror", kReflectance));
    add_quad(scene, lo + x, z, y);
    add_point_light(scene, kLamp, kIntensity_cd);
    finalize(scene);
  }

  /// From a point at `lamp`, lx.
  static double from_lx(const Vec3& lamp, const Vec3& p, const Vec3& n) {
    const glm::dvec3 way = glm::dvec3(lamp) - glm::dvec3(p);
    const double d2 = glm::dot(way, way);
    return static_cast<double>(kIntensity_cd) * std::max(0.0, glm::dot(way, glm::dvec3(n))) /
           (d2 * std::sqrt(d2));
  }
  static double image_lx(const Vec3& p, const Vec3& n) {
    return static_cast<double>(kReflectance) * from_lx({8 - kLamp.x, kLamp.y, kLamp.z}, p, n);
  }
  static double straight_lx(const Vec3& p, const Vec3& n) { return from_lx(kLamp, p, n); }

  /// On floor, ceiling and walls (in corners too), and in mid-air.
  static std::vector<Check> on_surfaces() {
    return {{{2, 0, 2.5f}, {0, 1, 0}},   {{0.05f, 0, 0.05f}, {0, 1, 0}}, {{3.9f, 0, 1}, {0, 1, 0}},
            {{1, 3, 4}, {0, -1, 0}},     {{0, 1.5f, 2.5f}, {1, 0, 0}},   {{2, 1, 0}, {0, 0, 1}},
            {{3, 2.95f, 5}, {0, 0, -1}}, {{0.5f, 0, 4.5f}, {0, 1, 0}}};
  }
  static std::vector<Check> in_air() {
    return {{{2, 1, 2.5f}, {1, 0, 0}},    {{2, 1, 2.5f}, {0, 1, 0}},       {{3, 1.5f, 1}, {0.6f, 0.8f, 0}},
            {{0.5f, 2.5f, 4}, {1, 0, 0}}, {{0.1f, 0.1f, 0.1f}, {1, 0, 0}}, {{3.9f, 1, 2}, {1, 0, 0}}};
  }
};

}  // namespace phos::test
