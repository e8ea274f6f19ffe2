// Skies and suns for tests.
#pragma once

#include <string>

#include "scene/sky/daylight.h"
#include "support/environment.h"

namespace phos::test {

/// By the options' words: type of the sky, sun at "AZIMUTH,ELEVATION". Black ground. 0: its usual
/// illuminance.
inline Environment sky_of(const std::string& sky, const std::string& sun, double sky_lx = 0,
                          std::optional<double> sun_lx = std::nullopt) {
  DaylightOptions o;
  o.sky = sky, o.sun = sun, o.sun_lx = sun_lx, o.ground_albedo = 0;
  if (sky_lx > 0) o.sky_lx = sky_lx;
  return make_environment(resolve(o));
}

/// The visible share of the sun's disc, whose centre is t of its radii beyond a straight edge (-1: hidden, 1:
/// all seen).
inline double seen_of_disc(double t) {
  if (t <= -1) return 0;
  if (t >= 1) return 1;
  return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / std::numbers::pi;
}

/// A black floor, and a roof high over its half at x < 0.
inline Scene under_an_edge(float height_m, float half_side_m) {
  Scene scene = open_floor(half_side_m, 0);
  begin_instance(scene, "roof", 0);
  const float a = half_side_m;
  add_quad(scene, {-a, height_m, -a}, {0, 0, 2 * a}, {a, 0, 0});
  return scene;
}

/// A wall from `corner` along unit `a` and `b`, of sides a_m and b_m, with a hole from a_m.y to a_m.z and
/// from b_m.y to b_m.z: x of both is the side.
inline void add_wall_with_hole(Scene& scene, const Vec3& corner, const Vec3& a, const Vec3& b,
                               const Vec3& a_m, const Vec3& b_m) {
  add_quad(scene, corner, a_m.y * a, b_m.x * b);
  add_quad(scene, corner + a_m.z * a, (a_m.x - a_m.z) * a, b_m.x * b);
  add_quad(scene, corner + a_m.y * a, (a_m.z - a_m.y) * a, b_m.y * b);
  add_quad(scene, corner + a_m.y * a + b_m.z * b, (a_m.z - a_m.y) * a, (b_m.x - b_m.z) * b);
}

/// A room of 5 x 3 x 4 m (x, y, z), with a hole in the wall at z = 4: x from 2 to 3, y from 1 to 2; perhaps
/// with a pane in it that changes nothing.
inline Scene room_with_window(float albedo, bool pane = false, bool hole = true) {
  Scene scene;
  const std::uint32_t grey = add_lambert(scene, "grey", albedo);
  begin_instance(scene, "floor", grey);
  add_quad(scene, {0, 0, 0}, {0, 0, 4}, {5, 0, 0});
  begin_instance(scene, "walls", grey);
  add_quad(scene, {0, 3, 0}, {5, 0, 0}, {0, 0, 4});
  add_quad(scene, {0, 0, 0}, {5, 0, 0}, {0, 3, 0});
  add_quad(scene, {0, 0, 0}, {0, 3, 0}, {0, 0, 4});
  add_quad(scene, {5, 0, 0}, {0, 0, 4}, {0, 3, 0});
  add_wall_with_hole(scene, {0, 0, 4}, {0, 1, 0}, {1, 0, 0}, {3, 1, 2}, {5, 2, 3});
  if (!hole) add_quad(scene, {2, 1, 4}, {0, 1, 0}, {1, 0, 0});
  if (pane) {
    const std::uint32_t glass = add_lambert(scene, "glass", 1);
    scene.material[glass].model = Model::thin_dielectric;
    scene.material[glass].ior = 1;
    begin_instance(scene, "pane", glass);
    add_quad(scene, {2, 1, 4}, {0, 1, 0}, {1, 0, 0});
  }
  return scene;
}

/// Horizontal illuminance through that window, nothing reflected: the integral over the hole of L cos cos /
/// r^2, lx. luminance(direction) is the sky's.
template <class Luminance>
double through_window_lx(const DVec3& point, const Luminance& luminance, int n = 40) {
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const DVec3 way = DVec3(2 + (i + 0.5) / n, 1 + (k + 0.5) / n, 4) - point;
      const double r2 = glm::dot(way, way);
      sum += luminance(way / std::sqrt(r2)) * way.y * way.z / (r2 * r2);
    }
  return sum / (static_cast<double>(n) * n);
}

}  // namespace phos::test
