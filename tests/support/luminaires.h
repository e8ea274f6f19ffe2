// Measured luminaires made by formulas, and scenes lit by them whose light is known.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "scene/luminaire/hang.h"
#include "scene/luminaire/photometric_file.h"
#include "support/scenes.h"

namespace phos::test {

/// Candela by C and gamma, in degrees, at nodes: C every `c_step_deg`, gamma every `gamma_step_deg` up to
/// `gamma_end_deg`.
struct Formula {
  std::function<double(double c_deg, double gamma_deg)> candela;
  double c_step_deg = 360, gamma_step_deg = 1, gamma_end_deg = 180;
};

inline PhotometricGrid grid_of(const Formula& f) {
  PhotometricGrid grid;
  for (int i = 0; i * f.c_step_deg <= 360; ++i) grid.azimuth_deg.push_back(i * f.c_step_deg);
  for (int j = 0; j * f.gamma_step_deg <= f.gamma_end_deg; ++j)
    grid.polar_deg.push_back(j * f.gamma_step_deg);
  for (const double c : grid.azimuth_deg)
    for (const double gamma : grid.polar_deg) grid.candela.push_back(static_cast<float>(f.candela(c, gamma)));
  return grid;
}

inline std::shared_ptr<const PhotometricFile> luminaire(const Formula& formula,
                                                        const LuminousOpening& opening = {}) {
  PhotometricFile file;
  file.format = "formula";
  file.photometry = std::make_shared<const Photometry>(grid_of(formula));
  file.opening = opening;
  return std::make_shared<const PhotometricFile>(file);
}

/// Linear between the nodes it is given at, brighter towards C0 and to the side: the interpolant is the
/// formula.
inline Formula lopsided(double scale = 1) {
  return {[=](double c, double gamma) { return scale * (100 + 2 * gamma) * (1 + std::fabs(c - 180) / 90); },
          180, 90, 90};
}
/// I0 cos(gamma): a flat opening with this distribution is equally bright from everywhere. In steps of a
/// quarter degree it is off by 2.4e-6 at most.
inline Formula lambertian(double candela) {
  return {
      [=](double, double gamma) { return candela * std::max(0.0, std::cos(gamma * std::numbers::pi / 180)); },
      360, 0.25, 90};
}
inline Formula isotropic(double candela) {
  return {[=](double, double) { return candela; }, 360, 90, 180};
}

/// Hangs one from (0, h, 0) straight down, C0 along +x; C90 is then along -z.
inline void hang(Scene& scene, std::shared_ptr<const PhotometricFile> file, const Vec3& position,
                 LuminairesAs as = LuminairesAs::openings, float size = 1) {
  hang_luminaire(scene, std::move(file),
                 {"luminaire", hanging_down(DVec3(position), {1, 0, 0}, size), Rgb(1)}, as);
}

/// Direction from a luminaire that hangs so, as C and gamma.
inline std::pair<double, double> c_gamma_deg(const Vec3& way) {
  const double x = way.x, y = -double(way.z), z = way.y;
  const double c = std::atan2(y, x) * 180 / std::numbers::pi;
  return {c < 0 ? c + 360 : c, std::atan2(std::hypot(x, y), -z) * 180 / std::numbers::pi};
}

/// A lopsided point over a square floor: E = I(C, gamma) cos / d2.
inline AnalyticScene measured_point_over_plane(float size = 1) {
  const float h = 2 * size;
  const double scale = double(size) * double(size);
  AnalyticScene s;
  s.name = "measured point x " + std::to_string(size);
  begin_instance(s.scene, "floor", add_lambert(s.scene, "grey", 0.5f));
  add_quad(s.scene, {-4 * h, 0, -4 * h}, {0, 0, 8 * h}, {8 * h, 0, 0});
  hang(s.scene, luminaire(lopsided(scale)), {0, h, 0});
  s.scene.camera.push_back(look_at({0, 1.5f * h, 2.5f * h}, {0, 0, 0}, {0, 1, 0}, 0.7f));
  finalize(s.scene);
  s.irradiance_lx = [=](const Vec3& p, const Vec3& n) {
    const auto [c, gamma] = c_gamma_deg(p - Vec3(0, h, 0));
    const double x = std::hypot(double(p.x), double(p.z));
    return n.y > 0 ? lopsided(scale).candela(c, gamma) * h / std::pow(double(h) * double(h) + x * x, 1.5)
                   : 0.0;
  };
  for (const Vec2& x : {Vec2{0.4f, 0.3f}, Vec2{0.75f, -0.2f}, Vec2{-0.6f, -1.25f}, Vec2{-1, 1}})
    s.check_at({h * x.x, 0, h * x.y}, {0, 1, 0});
  return s;
}

/// The rectangle of rectangle_light_parallel() as the opening of a Lambertian luminaire: I0 = L a b.
inline AnalyticScene measured_rectangle(float size = 1) {
  const float a = 2 * size, b = 3 * size, c = 1.5f * size, luminance_cd_m2 = 1000;
  AnalyticScene s = rectangle_light_parallel(a, b, c, luminance_cd_m2);
  s.name = "measured rectangle x " + std::to_string(size);
  const Camera camera = s.scene.camera[0];
  s.scene = Scene();
  const float border = 2 * std::max({a, b, c});
  begin_instance(s.scene, "floor", add_lambert(s.scene, "grey", 0.5f));
  add_quad(s.scene, {-border, 0, -border}, {0, 0, b + 2 * border}, {a + 2 * border, 0, 0});
  const LuminousOpening opening{LuminousOpening::Form::box, {2, 3, 0}};
  hang(s.scene, luminaire(lambertian(double(luminance_cd_m2) * double(a) * double(b)), opening),
       {0.5f * a, c, 0.5f * b}, LuminairesAs::openings, size);
  s.scene.camera.push_back(camera);
  finalize(s.scene);
  return s;
}

inline std::vector<AnalyticScene> luminaire_scenes() {
  std::vector<AnalyticScene> all;
  all.push_back(measured_point_over_plane());
  all.push_back(measured_rectangle());
  return all;
}

/// A closed room of 4 x 3 x 5 m about the origin, of one albedo, with a luminaire in its middle.
inline Scene measured_room(std::shared_ptr<const PhotometricFile> file, float albedo = 0,
                           LuminairesAs as = LuminairesAs::openings) {
  Scene scene;
  begin_instance(scene, "room", add_lambert(scene, "paint", albedo));
  add_room(scene, {-2, -1.5f, -2.5f}, {2, 1.5f, 2.5f});
  hang(scene, std::move(file), Vec3(0), as);
  finalize(scene);
  return scene;
}

}  // namespace phos::test
