// Scenes whose light is known in closed form, built in code. Lengths in metres, light in cd, cd/m2, lx. All
// light is grey (equal R, G, B), so that an expected value stands for each channel and for the luminance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/vector.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace phos::test {

/// A point on a surface, the side that is asked about, and the irradiance that falls on it.
struct Check {
  Vec3 position{0}, normal{0, 1, 0};
  double irradiance_lx = 0;
};

struct AnalyticScene {
  std::string name;
  Scene scene;
  /// Irradiance at any surface point on the side of the given normal, all bounces, lx. Empty where only the
  /// mean is known.
  std::function<double(const Vec3& position, const Vec3& normal)> irradiance_lx;
  /// Points well inside the surfaces, with irradiance_lx there.
  std::vector<Check> checks;
  /// Mean over all reflecting surface, lx, and that surface, m2. Closed scenes only; else 0.
  double mean_irradiance_lx = 0, area_m2 = 0;

  void check_at(const Vec3& position, const Vec3& normal) {
    checks.push_back({position, normal, irradiance_lx(position, normal)});
  }
};

// --- closed forms
// ------------------------------------------------------------------------------------------------

/// Point of intensity I (cd) at height h over a plane, at lateral distance x: E = I cos / d2 = I h / (h2 +
/// x2)^1.5.
inline double point_over_plane_lx(double intensity_cd, double h, double x) {
  return intensity_cd * h / std::pow(h * h + x * x, 1.5);
}

/// Form factor from an element to a parallel rectangle a x b at distance c whose corner stands over the
/// element: F = (1/pi) int_0^a int_0^b c2 / (x2 + y2 + c2)^2 dy dx
///   = [X/sqrt(1+X2) atan(Y/sqrt(1+X2)) + Y/sqrt(1+Y2) atan(X/sqrt(1+Y2))] / (2 pi),  X = a/c, Y = b/c.
/// Odd in a and in b, so that signed corner terms add up to any rectangle.
inline double corner_form_factor_parallel(double a, double b, double c) {
  const double x = a / c, y = b / c, sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
  return (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2 * std::numbers::pi);
}

/// Form factor from an element to a rectangle of width a and height b that stands on the element's plane at
/// distance c, a lower corner opposite the element: F = (1/pi) int_0^a int_0^b c z / (x2 + c2 + z2)^2 dz dx =
/// [atan(a/c) - c/sqrt(b2+c2) atan(a/sqrt(b2+c2))] / (2 pi). Odd in a.
inline double corner_form_factor_perpendicular(double a, double b, double c) {
  const double d = std::sqrt(b * b + c * c);
  return (std::atan(a / c) - c / d * std::atan(a / d)) / (2 * std::numbers::pi);
}

/// Closed room, every wall of exitance M (lm/m2) and reflectance rho: each bounce adds rho times the last, so
/// after n reflections E = M (1 + rho + ... + rho^n) = M (1 - rho^(n+1)) / (1 - rho). n < 0: all bounces, M /
/// (1 - rho).
inline double furnace_lx(double exitance, double albedo, int bounces = -1) {
  const double kept = bounces < 0 ? 0 : std::pow(albedo, bounces + 1);
  return exitance * (1 - kept) / (1 - albedo);
}

/// Any closed room of area A and one reflectance rho with a lamp of flux P inside: absorbed = emitted,
/// (1 - rho) A mean(E) = P. Of that, P / A arrives straight from the lamp.
inline double closed_room_mean_lx(double flux_lm, double area_m2, double albedo) {
  return flux_lm / (area_m2 * (1 - albedo));
}

// --- building
// ----------------------------------------------------------------------------------------------------

inline Camera look_at(const Vec3& eye, const Vec3& target, const Vec3& up, float yfov_rad) {
  Camera camera;
  camera.name = "camera";
  camera.to_world = glm::inverse(glm::lookAt(eye, target, up));
  camera.yfov_rad = yfov_rad;
  return camera;
}

/// Adds a material and returns its index.
inline std::uint32_t add_lambert(Scene& scene, const std::string& name, float albedo,
                                 float luminance_cd_m2 = 0) {
  Material m;
  m.name = name;
  m.model = Model::lambert;
  m.kd = Rgb(albedo);
  m.emission = Rgb(luminance_cd_m2);
  scene.material.push_back(m);
  return static_cast<std::uint32_t>(scene.material.size() - 1);
}

/// Starts an instance (one luminaire, if its material emits); the triangles added next are its own.
inline void begin_instance(Scene& scene, const std::string& node, std::uint32_t material) {
  Instance instance;
  instance.node = node;
  instance.material = material;
  instance.first_triangle = static_cast<std::uint32_t>(scene.triangle.size());
  scene.instance.push_back(instance);
}

/// Triangle with its own vertices and its geometric normal, (b-a) x (c-a), at each.
inline void add_triangle(Scene& scene, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto first = static_cast<std::uint32_t>(scene.position.size());
  const Vec3 n = normalized_or_zero(glm::cross(b - a, c - a));
  for (const Vec3& p : {a, b, c}) {
    scene.position.push_back(p);
    scene.normal.push_back(n);
  }
  scene.triangle.push_back({{first, first + 1, first + 2}});
  scene.triangle_instance.push_back(static_cast<std::uint32_t>(scene.instance.size() - 1));
  ++scene.instance.back().triangle_count;
}

/// Parallelogram corner, corner + u, corner + u + v, corner + v; front towards u x v.
inline void add_quad(Scene& scene, const Vec3& corner, const Vec3& u, const Vec3& v) {
  const auto first = static_cast<std::uint32_t>(scene.position.size());
  const auto own = static_cast<std::uint32_t>(scene.instance.size() - 1);
  const Vec3 n = normalized_or_zero(glm::cross(u, v));
  for (const Vec3& p : {corner, corner + u, corner + u + v, corner + v}) {
    scene.position.push_back(p);
    scene.normal.push_back(n);
  }
  scene.triangle.push_back({{first, first + 1, first + 2}});
  scene.triangle.push_back({{first, first + 2, first + 3}});
  scene.triangle_instance.insert(scene.triangle_instance.end(), 2, own);
  scene.instance.back().triangle_count += 2;
}

/// Six quads seen from inside (fronts inwards).
inline void add_room(Scene& scene, const Vec3& lo, const Vec3& hi) {
  const Vec3 d = hi - lo, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  add_quad(scene, lo, z, x);      // floor, +y
  add_quad(scene, lo + y, x, z);  // ceiling, -y
  add_quad(scene, lo, y, z);      // x = lo, +x
  add_quad(scene, lo + x, z, y);  // x = hi, -x
  add_quad(scene, lo, x, y);      // z = lo, +z
  add_quad(scene, lo + z, y, x);  // z = hi, -z
}

inline void add_point_light(Scene& scene, const Vec3& position, float intensity_cd) {
  Light light;
  light.kind = Light::Kind::point;
  light.name = "lamp " + std::to_string(scene.light.size());
  light.position = position;
  light.intensity = Rgb(intensity_cd);
  scene.light.push_back(light);
}

// --- scenes
// ------------------------------------------------------------------------------------------------------

/// Point light at (0, h, 0) over a square floor of half side 4 h at y = 0.
inline AnalyticScene point_light_over_plane(float h = 2, float intensity_cd = 1000, float albedo = 0.5f) {
  AnalyticScene s;
  s.name = "point light over plane";
  begin_instance(s.scene, "floor", add_lambert(s.scene, "grey", albedo));
  add_quad(s.scene, {-4 * h, 0, -4 * h}, {0, 0, 8 * h}, {8 * h, 0, 0});
  add_point_light(s.scene, {0, h, 0}, intensity_cd);
  s.scene.camera.push_back(look_at({0, 1.5f * h, 2.5f * h}, {0, 0, 0}, {0, 1, 0}, 0.7f));
  finalize(s.scene);
  s.irradiance_lx = [=](const Vec3& p, const Vec3& n) {
    return n.y > 0 ? point_over_plane_lx(intensity_cd, h, std::hypot(double(p.x), double(p.z))) : 0.0;
  };
  for (const Vec2& x : {Vec2{0, 0}, Vec2{0.75f, 0}, Vec2{0, -1.25f}, Vec2{1, 1}})
    s.check_at({h * x.x, 0, h * x.y}, {0, 1, 0});
  return s;
}

/// One-sided black rectangle [0,a] x [0,b] (x, z) at height c that shines down on a floor at y = 0. At a
/// floor point the four signed corner terms add up: E = pi L sum +-F(corner).
inline AnalyticScene rectangle_light_parallel(float a = 2, float b = 3, float c = 1.5f,
                                              float luminance_cd_m2 = 1000, float albedo = 0.5f) {
  AnalyticScene s;
  s.name = "parallel rectangle";
  const float border = 2 * std::max({a, b, c});
  begin_instance(s.scene, "floor", add_lambert(s.scene, "grey", albedo));
  add_quad(s.scene, {-border, 0, -border}, {0, 0, b + 2 * border}, {a + 2 * border, 0, 0});
  begin_instance(s.scene, "light", add_lambert(s.scene, "light", 0, luminance_cd_m2));
  add_quad(s.scene, {0, c, 0}, {a, 0, 0}, {0, 0, b});
  s.scene.camera.push_back(
      look_at({0.5f * a, 0.8f * c, b + border}, {0.5f * a, 0, 0.5f * b}, {0, 1, 0}, 0.6f));
  finalize(s.scene);
  s.irradiance_lx = [=](const Vec3& p, const Vec3& n) {
    if (p.y > 0.5f * c || n.y <= 0) return 0.0;
    const double x0 = -double(p.x), x1 = double(a) - double(p.x), z0 = -double(p.z),
                 z1 = double(b) - double(p.z);
    const double f = corner_form_factor_parallel(x1, z1, c) - corner_form_factor_parallel(x0, z1, c) -
                     corner_form_factor_parallel(x1, z0, c) + corner_form_factor_parallel(x0, z0, c);
    return std::numbers::pi * luminance_cd_m2 * f;
  };
  for (const Vec2& x :
       {Vec2{0, 0}, Vec2{0.5f * a, 0.5f * b}, Vec2{a + 0.3f * c, 0.5f * b}, Vec2{-0.5f * c, -0.5f * c}})
    s.check_at({x.x, 0, x.y}, {0, 1, 0});
  return s;
}

/// One-sided black rectangle of width a (x from 0) and height b (y from 0) in the plane z = 0, shining
/// towards +z over a floor at y = 0, z >= 0. E at (x, 0, c) = pi L [F(a - x, b, c) + F(x, b, c)].
inline AnalyticScene rectangle_light_perpendicular(float a = 2, float b = 3, float luminance_cd_m2 = 1000,
                                                   float albedo = 0.5f) {
  AnalyticScene s;
  s.name = "perpendicular rectangle";
  const float far = 3 * std::max(a, b);
  begin_instance(s.scene, "floor", add_lambert(s.scene, "grey", albedo));
  add_quad(s.scene, {-far, 0, 0}, {0, 0, far}, {a + 2 * far, 0, 0});
  begin_instance(s.scene, "light", add_lambert(s.scene, "light", 0, luminance_cd_m2));
  add_quad(s.scene, {0, 0, 0}, {a, 0, 0}, {0, b, 0});
  s.scene.camera.push_back(look_at({0.5f * a, b, far}, {0.5f * a, 0, 0.3f * far}, {0, 1, 0}, 0.7f));
  finalize(s.scene);
  s.irradiance_lx = [=](const Vec3& p, const Vec3& n) {
    if (n.y <= 0.5f || p.z <= 0) return 0.0;
    const double f = corner_form_factor_perpendicular(double(a) - double(p.x), b, p.z) +
                     corner_form_factor_perpendicular(p.x, b, p.z);
    return std::numbers::pi * luminance_cd_m2 * f;
  };
  for (const Vec2& x :
       {Vec2{0, 0.75f * a}, Vec2{0.5f * a, 0.5f * b}, Vec2{0.5f * a, b}, Vec2{-0.4f * a, 0.6f * a}})
    s.check_at({x.x, 0, x.y}, {0, 1, 0});
  return s;
}

/// Points inside each wall of a room, off centre.
inline void check_walls(AnalyticScene& s, const Vec3& lo, const Vec3& hi) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      Vec3 p = lo + (hi - lo) * Vec3(0.4f, 0.55f, 0.35f), n(0);
      p[axis] = high ? hi[axis] : lo[axis];
      n[axis] = high ? -1.f : 1.f;
      s.check_at(p, n);
    }
  }
}

/// Closed room of 2 x 1 x 1.5 m in which each wall emits `luminance_cd_m2` and reflects `albedo`:
/// E = M / (1 - rho) everywhere, M = pi L. The default emits M = 1.
inline AnalyticScene furnace(float albedo, float luminance_cd_m2 = 1 / kPi) {
  AnalyticScene s;
  s.name = "furnace";
  const Vec3 lo(0), hi(2, 1, 1.5f), d = hi - lo;
  begin_instance(s.scene, "walls", add_lambert(s.scene, "glowing", albedo, luminance_cd_m2));
  add_room(s.scene, lo, hi);
  s.scene.camera.push_back(look_at({0.5f, 0.6f, 1.2f}, {1.5f, 0.3f, 0.4f}, {0, 1, 0}, 1));
  finalize(s.scene);
  s.area_m2 = 2.0 * (double(d.x) * double(d.y) + double(d.y) * double(d.z) + double(d.z) * double(d.x));
  s.mean_irradiance_lx = furnace_lx(std::numbers::pi * luminance_cd_m2, albedo);
  s.irradiance_lx = [e = s.mean_irradiance_lx](const Vec3&, const Vec3&) { return e; };
  check_walls(s, lo, hi);
  return s;
}

/// Sphere of at least `triangles` flat facets (a subdivided icosahedron: 20, 80, 320, 1280, ...), fronts
/// inwards, uniform albedo, isotropic lamp of `flux_lm` at its centre. The area mean is exact for the facets
/// as they are (closed room).
inline AnalyticScene integrating_sphere(float albedo, int triangles = 1280, float radius_m = 1,
                                        float flux_lm = 100) {
  AnalyticScene s;
  s.name = "integrating sphere";
  begin_instance(s.scene, "sphere", add_lambert(s.scene, "coating", albedo));
  const float g = 0.5f * (1 + std::sqrt(5.f));
  std::vector<Vec3> corner;
  for (const float i : {-1.f, 1.f})
    for (const float j : {-g, g})
      for (const Vec3& p : {Vec3(0, i, j), Vec3(i, j, 0), Vec3(j, 0, i)}) corner.push_back(glm::normalize(p));
  std::vector<std::array<Vec3, 3>> facets;
  const float edge =
      2 / std::sqrt(1 + g * g) * 1.01f;  // any three corners this near to each other are a facet
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = i + 1; j < 12; ++j)
      for (std::size_t k = j + 1; k < 12; ++k)
        if (glm::distance(corner[i], corner[j]) < edge && glm::distance(corner[j], corner[k]) < edge &&
            glm::distance(corner[k], corner[i]) < edge)
          facets.push_back({corner[i], corner[j], corner[k]});
  while (facets.size() < static_cast<std::size_t>(std::max(triangles, 20))) {
    std::vector<std::array<Vec3, 3>> finer;
    for (const auto& [a, b, c] : facets) {
      const Vec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
      for (const std::array<Vec3, 3>& f : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(f);
    }
    facets = std::move(finer);
  }
  for (auto [a, b, c] : facets) {
    if (glm::dot(glm::cross(b - a, c - a), a) > 0) std::swap(b, c);
    add_triangle(s.scene, radius_m * a, radius_m * b, radius_m * c);
    s.area_m2 += 0.5 * glm::length(glm::cross(DVec3(radius_m * b) - DVec3(radius_m * a),
                                              DVec3(radius_m * c) - DVec3(radius_m * a)));
  }
  add_point_light(s.scene, Vec3(0), flux_lm / (4 * kPi));
  s.scene.camera.push_back(look_at({0, 0, 0.8f * radius_m}, {0, 0, 0}, {0, 1, 0}, 1.2f));
  finalize(s.scene);
  s.mean_irradiance_lx = closed_room_mean_lx(flux_lm, s.area_m2, albedo);
  return s;
}

/// Black room of 4 m whose walls all emit L, round a small square of reflectance `albedo`: the square sees L
/// in each direction on each side, and nothing that it reflects comes back: E = pi L.
inline AnalyticScene emitting_environment(float luminance_cd_m2 = 100, float albedo = 0.5f) {
  AnalyticScene s;
  s.name = "emitting environment";
  begin_instance(s.scene, "sky", add_lambert(s.scene, "sky", 0, luminance_cd_m2));
  add_room(s.scene, Vec3(-2), Vec3(2));
  begin_instance(s.scene, "sheet", add_lambert(s.scene, "grey", albedo));
  const Vec3 u(1, 0.25f, 0), v = glm::cross(glm::normalize(Vec3(-0.25f, 1, 0.5f)), glm::normalize(u));
  add_quad(s.scene, -0.5f * (u + v), v, u);
  const Vec3 n = glm::normalize(glm::cross(v, u));
  s.scene.camera.push_back(look_at(1.5f * n, {0, 0, 0}, u, 0.8f));
  finalize(s.scene);
  s.irradiance_lx = [=](const Vec3&, const Vec3&) { return std::numbers::pi * luminance_cd_m2; };
  s.check_at({0, 0, 0}, n);
  s.check_at({0, 0, 0}, -n);
  s.check_at(0.2f * u - 0.15f * v, n);
  return s;
}

/// Closed room of 2 x 1 x 1.5 m, one albedo, point lamp off centre: mean E = P / (A (1 - rho)).
inline AnalyticScene uniform_box(float albedo, float flux_lm = 100) {
  AnalyticScene s;
  s.name = "uniform box";
  begin_instance(s.scene, "walls", add_lambert(s.scene, "grey", albedo));
  add_room(s.scene, Vec3(0), Vec3(2, 1, 1.5f));
  add_point_light(s.scene, {0.7f, 0.6f, 0.5f}, flux_lm / (4 * kPi));
  s.scene.camera.push_back(look_at({0.3f, 0.6f, 1.3f}, {1.5f, 0.3f, 0.4f}, {0, 1, 0}, 1));
  finalize(s.scene);
  s.area_m2 = 2 * (2 * 1 + 1 * 1.5 + 1.5 * 2);
  s.mean_irradiance_lx = albedo < 1 ? closed_room_mean_lx(flux_lm, s.area_m2, albedo) : HUGE_VAL;
  return s;
}

/// Two walls of 4 x 4 m without thickness, at z = 0 and z = -gap, a point light 1 m before the first. Only
/// the front of the first (+z) is lit, E = I h / (h2 + x2)^1.5; its back and both sides of the second are
/// dark: 0.
inline AnalyticScene thin_walls(float intensity_cd = 1000, float gap_m = 0.01f, float albedo = 0.5f) {
  AnalyticScene s;
  s.name = "thin walls";
  const std::uint32_t grey = add_lambert(s.scene, "grey", albedo);
  begin_instance(s.scene, "lit wall", grey);
  add_quad(s.scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
  begin_instance(s.scene, "dark wall", grey);
  add_quad(s.scene, {-2, -2, -gap_m}, {4, 0, 0}, {0, 4, 0});
  add_point_light(s.scene, {0, 0, 1}, intensity_cd);
  s.scene.camera.push_back(look_at({0.5f, 0.5f, 3}, {0, 0, 0}, {0, 1, 0}, 0.8f));
  finalize(s.scene);
  s.irradiance_lx = [=](const Vec3& p, const Vec3& n) {
    const bool lit = n.z > 0 && p.z > -0.5f * gap_m;
    return lit ? point_over_plane_lx(intensity_cd, 1, std::hypot(double(p.x), double(p.y))) : 0.0;
  };
  for (const float z : {0.f, -gap_m})
    for (const float side : {1.f, -1.f})
      for (const float x : {0.f, 0.8f}) s.check_at({x, 0.1f, z}, {0, 0, side});
  return s;
}

/// Horizontal sheet of 4 x 4 m at y = 0 with a point light 1 m above it and another, of other intensity, 1 m
/// below.
inline AnalyticScene two_sided_sheet(float above_cd = 1000, float below_cd = 10, float albedo = 0.5f) {
  AnalyticScene s;
  s.name = "two-sided sheet";
  begin_instance(s.scene, "sheet", add_lambert(s.scene, "grey", albedo));
  add_quad(s.scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  add_point_light(s.scene, {0, 1, 0}, above_cd);
  add_point_light(s.scene, {0, -1, 0}, below_cd);
  s.scene.camera.push_back(look_at({0, 2, 3}, {0, 0, 0}, {0, 1, 0}, 0.8f));
  finalize(s.scene);
  s.irradiance_lx = [=](const Vec3& p, const Vec3& n) {
    return point_over_plane_lx(n.y > 0 ? above_cd : below_cd, 1, std::hypot(double(p.x), double(p.z)));
  };
  for (const float side : {1.f, -1.f})
    for (const float x : {0.f, 0.6f}) s.check_at({x, 0, 0.2f}, {0, side, 0});
  return s;
}

/// Every scene with a known irradiance at points (not only a mean), at default size.
inline std::vector<AnalyticScene> all_point_scenes() {
  std::vector<AnalyticScene> all;
  all.push_back(point_light_over_plane());
  all.push_back(rectangle_light_parallel());
  all.push_back(rectangle_light_perpendicular());
  for (const float albedo : {0.1f, 0.5f, 0.9f, 0.99f}) all.push_back(furnace(albedo));
  all.push_back(emitting_environment());
  all.push_back(thin_walls());
  all.push_back(two_sided_sheet());
  return all;
}

/// The scene with all lengths multiplied by the factor. Its lamps are such that lux and cd/m2 stay the same
/// (candela grow with the square).
inline Scene scaled(const Scene& original, float factor) {
  Scene scene = original;
  for (Vec3& p : scene.position) p *= factor;
  const Mat4 grow = glm::scale(Mat4(1), Vec3(factor));
  for (Instance& instance : scene.instance) instance.to_world = grow * instance.to_world;
  std::erase_if(scene.light,
                [](const Light& l) { return l.kind == Light::Kind::area; });  // finalize makes them again
  for (Light& light : scene.light) {
    light.position *= factor;
    if (light.kind != Light::Kind::directional) light.intensity *= factor * factor;
  }
  for (Camera& camera : scene.camera) {
    camera.to_world[3] = Vec4(factor * Vec3(camera.to_world[3]), 1);
    camera.ymag_m *= factor;
  }
  scene.bounds = {};
  finalize(scene);
  return scene;
}

inline AnalyticScene scaled(const AnalyticScene& original, float factor) {
  AnalyticScene s = original;
  s.name = original.name + " x " + std::to_string(factor);
  s.scene = scaled(original.scene, factor);
  if (original.irradiance_lx)
    s.irradiance_lx = [f = original.irradiance_lx, factor](const Vec3& p, const Vec3& n) {
      return f(p / factor, n);
    };
  for (Check& check : s.checks) check.position *= factor;
  s.area_m2 *= double(factor) * double(factor);
  return s;
}

/// The Cornell box of the data folder.
inline Scene cornell() { return load_scene(PHOS_SOURCE "/data/cornell-measured.glb"); }

}  // namespace phos::test
