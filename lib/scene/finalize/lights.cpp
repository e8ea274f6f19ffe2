#include "scene/finalize/lights.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/json.h"
#include "scene/sky/environment.h"
#include "scene/texture/texture.h"

namespace phos::inline scene {
namespace {

/// Points per side of the grid over a triangle on which an emissive texture is averaged; texels beyond it are
/// sampled.
constexpr int kMaxGrid = 64;
/// The same at least, where a part of the triangle is cut out.
constexpr float kLeastMaskedGrid = 16;

/// KHR_lights_punctual: (t)^2 with t linear in the cosine from the outer to the inner cone, integrated over
/// the sphere.
Rgb spot_flux_lm(const Light& light) {
  const double inner = light.cos_inner, outer = light.cos_outer;
  const double solid_angle_sr = 2 * std::numbers::pi * ((1 - inner) + (inner - outer) / 3);
  return light.intensity * static_cast<float>(solid_angle_sr);
}

void fill_area_light(const Scene& scene, Light& light) {
  const Instance& instance = scene.instance[light.instance];
  const Material& material = scene.material[instance.material];
  double area = 0;
  glm::dvec3 flux(0);
  for (std::uint32_t t = instance.first_triangle; t < instance.first_triangle + instance.triangle_count;
       ++t) {
    const double a = area_m2(scene, t);
    area += a;
    flux += a * std::numbers::pi * glm::dvec3(mean_emission(scene, t));
  }
  light.area_m2 = static_cast<float>(area);
  light.fitting = instance.fitting;
  if (light.fitting >= 0) {
    light.flux_lm = scene.fitting[static_cast<std::size_t>(light.fitting)].flux_lm();
    return;
  }
  light.flux_lm = Rgb(material.double_sided ? 2.0 * flux : flux);
}

/// Surfaces of luminous openings, and their mean luminance.
void fill_openings(Scene& scene) {
  for (const Instance& instance : scene.instance) {
    if (instance.fitting < 0) continue;
    Fitting& fitting = scene.fitting[static_cast<std::size_t>(instance.fitting)];
    Material& material = scene.material[instance.material];
    std::vector<Vec4> facets;
    double area = 0;
    for (std::uint32_t t = instance.first_triangle; t < instance.first_triangle + instance.triangle_count;
         ++t) {
      facets.emplace_back(geometric_normal(scene, t), area_m2(scene, t));
      area += static_cast<double>(facets.back().w);
    }
    fitting.set_surface(facets, material.double_sided);
    const double emitting = std::numbers::pi * area * (material.double_sided ? 2 : 1);
    material.emission = area > 0 ? Rgb(DVec3(fitting.flux_lm()) / emitting) : Rgb(0);
  }
}

/// From here on estimates hold (docs/reference/measured-limits.md): paths share lumens, lux is lumens over
/// squares of lengths, and its slopes over cubes. Below, floats begin to lose digits.
void require_power(Scene& scene) {
  constexpr double kLeast_lm = 1e-24, kLeastSlope = 1e-33;  // lm, lm/m3
  const double size_m = static_cast<double>(scene.bounds.diagonal_m());
  const Light* brightest = nullptr;
  for (const Light& light : scene.light)
    if (!brightest || max_component(light.flux_lm) > max_component(brightest->flux_lm)) brightest = &light;
  if (!brightest) return;
  const float flux_lm = max_component(brightest->flux_lm);
  const double lm = static_cast<double>(flux_lm), slope = size_m > 0 ? lm / (size_m * size_m * size_m) : 1;
  if (lm < kLeast_lm || slope < kLeastSlope)
    throw Error(ExitCode::bad_input, scene.path,
                text("light \"", brightest->name, "\", the brightest, emits ", shortest(flux_lm),
                     " lm in a scene of ", shortest(scene.bounds.diagonal_m()),
                     " m: too little for 32-bit numbers; give the lights or the scene other units"));
  for (const Light& light : scene.light) {
    const float own_lm = max_component(light.flux_lm);
    if (static_cast<double>(own_lm) >= kLeast_lm) continue;
    scene.warnings.emplace_back(Note::Level::warning, kLightTooFaint, "light", light.name,
                                text("emits only ", shortest(own_lm), " lm: ", kFaintLight));
  }
}

}  // namespace

namespace {

/// Texels of a use along the sides of a triangle.
float texels_across(const Scene& scene, std::uint32_t triangle, const TextureUse& use) {
  if (!use.used()) return 1;
  const Texture& texture = scene.texture[static_cast<std::size_t>(use.texture)];
  const auto corner = [&](float u, float v) {
    return transformed(use, texture_coordinates(scene, triangle, use.set, u, v));
  };
  const Vec2 size(texture.width, texture.height);
  const Vec2 span =
      glm::max(glm::abs(corner(1, 0) - corner(0, 0)), glm::abs(corner(0, 1) - corner(0, 0))) * size;
  return std::max(span.x, span.y);
}

/// Points per side of the grid on which a triangle's emission is averaged. The edge of a cut-out may run
/// anywhere within a texel.
int grid_of(const Scene& scene, std::uint32_t triangle) {
  const Material& material = scene.material_of(triangle);
  const bool opaque = material.alpha_mode == Material::Alpha::opaque;
  float texels = texels_across(scene, triangle, material.emissive);
  if (!opaque) texels = std::max(texels, texels_across(scene, triangle, material.base_colour));
  const float least = opaque ? 1.f : kLeastMaskedGrid;
  return std::isfinite(texels) ? static_cast<int>(std::clamp(std::ceil(texels), least, float{kMaxGrid})) : 1;
}

}  // namespace

Rgb mean_emission(const Scene& scene, std::uint32_t triangle) {
  const Material& material = scene.material_of(triangle);
  if (!material.emissive.used() && material.alpha_mode == Material::Alpha::opaque) return material.emission;
  const int n = grid_of(scene, triangle);
  // Centroids of the n^2 equal triangles of an n-fold subdivision.
  glm::dvec3 sum(0);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      const int both = i + j + 1 < n ? 2 : 1;
      for (int k = 0; k < both; ++k) {
        const float third = k == 0 ? 1.0f / 3 : 2.0f / 3;
        const float u = (static_cast<float>(i) + third) / static_cast<float>(n);
        const float v = (static_cast<float>(j) + third) / static_cast<float>(n);
        sum += glm::dvec3(emission_at(scene, triangle, u, v));
      }
    }
  }
  return Rgb(sum / (static_cast<double>(n) * n));
}

void fill_lights(Scene& scene) {
  fill_openings(scene);
  std::erase_if(scene.light, [](const Light& light) {
    return light.kind == Light::Kind::area || light.kind == Light::Kind::environment;
  });
  if (scene.environment) {
    Light light;
    light.kind = Light::Kind::environment;
    light.name = "environment";
    scene.light.push_back(light);
  }
  for (std::uint32_t i = 0; i < scene.instance.size(); ++i) {
    const Instance& instance = scene.instance[i];
    if (!scene.material[instance.material].emits()) continue;
    Light light;
    light.kind = Light::Kind::area;
    light.name = instance.node;
    light.instance = i;
    fill_area_light(scene, light);
    if (max_component(light.flux_lm) > 0) {
      scene.light.push_back(light);
    } else {
      const bool opaque = scene.material[instance.material].alpha_mode == Material::Alpha::opaque;
      const char* why = opaque || !(light.area_m2 > 0) ? "has no area or is black"
                                                       : "is cut out wholly by its alpha, or black";
      scene.warnings.emplace_back(Note::Level::info, kLightIgnored, "light", instance.node,
                                  text(why, ": it is ignored"));
    }
  }
  const float radius_m = bounding_radius_m(scene);
  const float disc_m2 = kPi * radius_m * radius_m;
  for (Light& light : scene.light) {
    if (light.kind == Light::Kind::point) light.flux_lm = 4 * kPi * light.intensity;
    if (light.kind == Light::Kind::spot) light.flux_lm = spot_flux_lm(light);
    if (light.kind == Light::Kind::measured) {
      const Fitting& fitting = scene.fitting[static_cast<std::size_t>(light.fitting)];
      light.direction = fitting.down(), light.intensity = fitting.peak_cd(),
      light.flux_lm = fitting.flux_lm();
    }
    if (light.kind == Light::Kind::directional) light.flux_lm = light.intensity * disc_m2;
    if (light.kind == Light::Kind::environment)
      light.flux_lm = Rgb(scene.environment->integral_lx()) * disc_m2;
  }
  for (const Light& light : scene.light) {
    if (is_finite(light.flux_lm)) continue;
    throw Error(ExitCode::bad_input, scene.path,
                text("light \"", light.name, "\" emits more than numbers can hold; give it a finite power"));
  }
  std::erase_if(scene.light, [&](const Light& light) {
    if (max_component(light.flux_lm) > 0) return false;
    // In a band many a lamp is dark.
    if (scene.bands.number == 0)
      scene.warnings.emplace_back(Note::Level::info, kLightIgnored, "light", light.name,
                                  "has no intensity: it is ignored");
    return true;
  });
  require_power(scene);
}

}  // namespace phos::inline scene
