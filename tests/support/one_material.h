// A scene of one material and a point on it, to look at reflection models alone.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/material/bsdf.h"
#include "scene/scene.h"
#include "support/merl_bytes.h"

namespace phos::test {

struct Named {
  std::string name;
  Material material;
};

/// Material::measured of the tables that scene_of gives a scene.
enum MeasuredTable : std::int32_t { kMeasuredLambert, kMeasuredHalfLobe, kMeasuredMirrorLobe };

/// Made once in a process: they take a while.
inline const std::vector<std::shared_ptr<const MerlBrdf>>& measured_tables() {
  const auto table = [](const std::string& bytes) {
    return std::make_shared<const MerlBrdf>(bytes, "measured.binary");
  };
  static const std::vector<std::shared_ptr<const MerlBrdf>> tables = {
      table(merl_bytes(HalfLobe{Rgb(0.8f, 0.5f, 0.2f)})),
      table(merl_bytes(HalfLobe{Rgb(0.5f, 0.3f, 0.1f), Rgb(0.2f, 0.25f, 0.3f), 60})),
      table(merl_bytes(MirrorLobe{Rgb(0.4f), Rgb(0.5f, 0.4f, 0.3f), 15}))};
  return tables;
}

inline Scene scene_of(const Material& material) {
  Scene scene;
  scene.material = {material};
  if (material.model == Model::measured) scene.measured = measured_tables();
  return scene;
}

/// The front of a plane at the origin, z up, x the tangent.
inline SurfacePoint flat_point() {
  SurfacePoint point;
  point.tangent = Vec3(1, 0, 0);
  return point;
}

inline Material make_material(Model model, const Rgb& kd, const Rgb& ks, float a = 0, float b = 0) {
  Material m;
  m.model = model;
  m.kd = kd, m.ks = ks;
  m.alpha_x = a, m.alpha_y = b;
  return m;
}

inline Material oren_nayar(const Rgb& kd, float sigma_rad) {
  Material m = make_material(Model::oren_nayar, kd, Rgb(0));
  m.sigma_rad = sigma_rad;
  return m;
}

inline Material phong(float exponent, const std::string& name) {
  Material m = make_material(Model::phong, Rgb(0.1f), Rgb(0.8f, 0.5f, 0.2f));
  m.name = name, m.exponent = exponent;
  return m;
}

/// Every model that has a density, with lobes broad enough for a quadrature on a grid; as bright as can be.
inline std::vector<Named> models() {
  std::vector<Named> all;
  const auto add = [&](const std::string& name, const Material& m) { all.push_back({name, m}); };
  add("lambert", make_material(Model::lambert, Rgb(1), Rgb(0)));
  for (const float n : {0.f, 1.f, 22.f, 100.f}) {
    Material m = make_material(Model::phong, Rgb(0.4f, 0.3f, 0.2f), Rgb(0.6f, 0.5f, 0.4f));
    m.exponent = n;
    add("phong " + std::to_string(static_cast<int>(n)), m);
  }
  add("ward", make_material(Model::ward, Rgb(0.3f), Rgb(0.7f), 0.2f, 0.2f));
  add("ward, anisotropic", make_material(Model::ward, Rgb(0), Rgb(1), 0.15f, 0.5f));
  add("plastic 0.1", make_material(Model::plastic, Rgb(1, 0.8f, 0.2f), Rgb(0), 0.1f, 0.1f));
  add("plastic 0.1 0.4", make_material(Model::plastic, Rgb(1), Rgb(0), 0.1f, 0.4f));
  add("plastic 0.6", make_material(Model::plastic, Rgb(1), Rgb(0), 0.6f, 0.6f));
  add("conductor 0.15", make_material(Model::conductor, Rgb(0), Rgb(1, 0.7f, 0.3f), 0.15f, 0.15f));
  add("conductor 0.15 0.6", make_material(Model::conductor, Rgb(0), Rgb(1), 0.15f, 0.6f));
  add("conductor 1", make_material(Model::conductor, Rgb(0), Rgb(1), 1, 1));
  for (const float metallic : {0.f, 0.5f, 1.f}) {
    for (const float roughness : {0.35f, 1.f}) {
      Material m = make_material(Model::metallic_roughness, Rgb(1, 0.9f, 0.5f), Rgb(0));
      m.metallic = metallic, m.roughness = roughness;
      add("metallic " + std::to_string(metallic) + " roughness " + std::to_string(roughness), m);
    }
  }
  for (const float metallic : {0.f, 1.f}) {
    Material m = make_material(Model::metallic_roughness, Rgb(1, 0.9f, 0.5f), Rgb(0));
    m.metallic = metallic, m.roughness = 0.5f, m.anisotropy = 0.6f;
    add("brushed, metallic " + std::to_string(metallic), m);
  }
  for (const float sigma : {0.1f, 0.5f, 1.5f})
    add("oren-nayar " + std::to_string(sigma), oren_nayar(Rgb(1, 0.8f, 0.3f), sigma));
  Material clear = make_material(Model::metallic_roughness, Rgb(1), Rgb(0));
  clear.transmission = 0.6f, clear.roughness = 0.5f;
  add("transmission", clear);
  for (const MeasuredTable table : {kMeasuredLambert, kMeasuredHalfLobe, kMeasuredMirrorLobe}) {
    Material m = make_material(Model::measured, Rgb(0), Rgb(0));
    m.measured = table;
    add("measured " + std::to_string(table), m);
  }
  return all;
}

inline Vec3 direction(float cos_theta, float phi) {
  const float s = std::sqrt(1 - cos_theta * cos_theta);
  return {s * std::cos(phi), s * std::sin(phi), cos_theta};
}

}  // namespace phos::test
