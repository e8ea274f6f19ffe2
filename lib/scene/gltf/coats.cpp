#include "scene/gltf/coats.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/material/models.h"
#include "scene/texture/texture.h"

namespace phos::inline scene {
namespace {

constexpr const char* kClearcoat = "extensions/KHR_materials_clearcoat";
constexpr const char* kSheen = "extensions/KHR_materials_sheen";
constexpr float kMetal = 0.5f;           // metallic from which the base is a metal
constexpr double kCoatIor = 1.5;         // as the extension has it
constexpr double kCoatOnMetal = 0.0918;  // Fresnel's mean at that index

/// Schlick's reflectance, the mean over the hemisphere.
double mean_schlick(double ior) {
  const double f0 = (ior - 1) / (ior + 1) * (ior - 1) / (ior + 1);
  return f0 + (1 - f0) / 21;
}

/// The base colour becomes added + kept times itself.
void change_base(const Scene& scene, Material& m, const Rgb& added, float kept) {
  const Vec4 texel = mean_texel(scene, m.base_colour);
  for (int c = 0; c < 3; ++c) {
    const float most = std::max(1.0f, m.kd[c]);
    const float own = texel[c] > 0 ? added[c] / texel[c] : added[c];
    m.kd[c] = std::min(kept * m.kd[c] + own, most);
  }
}

/// G term of the sheen extension: exp of a fit by Estevez and Kulla 2017.
double sheen_lambda(double cosine, double alpha) {
  const double t = (1 - alpha) * (1 - alpha);
  const auto mix = [&](double rough, double smooth) { return rough + t * (smooth - rough); };
  const double a = mix(21.5473, 25.3245), b = mix(3.82987, 3.32435), c = mix(0.19823, 0.16801),
               d = mix(-1.97760, -1.27393), e = mix(-4.32054, -4.85967);
  const auto l = [&](double x) { return a / (1 + b * std::pow(x, c)) + d * x + e; };
  return std::exp(cosine < 0.5 ? l(cosine) : 2 * l(0.5) - l(1 - cosine));
}

void lay_sheen(const Scene& scene, Material& m, const Rgb& colour, double roughness) {
  const auto albedo = static_cast<float>(mean_sheen_albedo(roughness));
  const float left = 1 - max_component(colour) * albedo;
  if (m.metallic > kMetal) return change_base(scene, m, albedo * colour, left);
  const auto lobe = static_cast<float>(mean_schlick(static_cast<double>(m.ior)));
  const float before = m.specular * lobe;
  m.specular *= left;
  const float now = m.specular * lobe;
  change_base(scene, m, albedo / (1 - now) * colour, left * (1 - before) / (1 - now));
}

void lay_coat(const Scene& scene, Material& m, float coat, float roughness) {
  if (m.metallic > kMetal) {
    const float added = coat * static_cast<float>(kCoatOnMetal);
    return change_base(scene, m, Rgb(added), 1 - added);
  }
  const auto of_coat = coat * static_cast<float>(mean_schlick(kCoatIor));
  auto lobe = static_cast<float>(mean_schlick(static_cast<double>(m.ior)));
  const float of_base = m.specular * lobe;
  const float both = 1 - (1 - of_coat) * (1 - of_base);
  if (of_coat >= (1 - of_coat) * of_base && !m.metallic_roughness.used() && m.anisotropy == 0) {
    m.roughness = roughness;
    m.alpha_x = m.alpha_y = roughness * roughness;
    m.ior = static_cast<float>(kCoatIor), m.specular_colour = Rgb(1);
    lobe = static_cast<float>(mean_schlick(kCoatIor));
  }
  m.specular = std::min(1.0f, both / lobe);
  const float now = m.specular * lobe;
  change_base(scene, m, Rgb(std::max(both - now, 0.0f) / (1 - now)), (1 - both) / (1 - now));
}

}  // namespace

double mean_sheen_albedo(double roughness) {
  constexpr int kCosines = 48, kAzimuths = 48;
  const double alpha = std::max(roughness * roughness, 1e-3), k = 1 / alpha;
  double sum = 0;
  for (int i = 0; i < kCosines; ++i) {
    for (int o = 0; o < kCosines; ++o) {
      const double ci = (i + 0.5) / kCosines, co = (o + 0.5) / kCosines;
      const double si = std::sqrt(1 - ci * ci), so = std::sqrt(1 - co * co);
      // f cos cos over both solid angles, less the 4 ci co of the visibility
      const double visible = 1 / (1 + sheen_lambda(ci, alpha) + sheen_lambda(co, alpha));
      double d = 0;
      for (int a = 0; a < kAzimuths; ++a) {
        const double phi = (a + 0.5) / kAzimuths * std::numbers::pi;
        const double dot = si * so * std::cos(phi) + ci * co;  // between both directions
        const double cosine = (ci + co) / std::sqrt(std::max(2 + 2 * dot, 1e-12));
        d += std::pow(std::sqrt(std::max(1 - cosine * cosine, 0.0)), k);
      }
      sum += visible * d / kAzimuths;
    }
  }
  // 2 integral of co dco integral of D G / (4 ci co) ci over ci and an azimuth of 2 pi, D = (2 + k) / (2 pi)
  // sin^k.
  return std::min((2 + k) / 2 * sum / (kCosines * kCosines), 1.0);
}

void lay_coats(const GltfDocument& document, Scene& scene) {
  for (std::size_t i = 0; i < scene.material.size(); ++i) {
    const Json& json = element(document.json, "materials", i);
    const Json *sheen = find_path(json, kSheen), *coat = find_path(json, kClearcoat);
    Material& m = scene.material[i];
    if ((!sheen && !coat) || !row_of(m).gltf_core || m.transmission > 0) continue;
    const auto check = [&](double value, const char* what) {
      if (!(value >= 0 && value <= 1))
        document.fail(text("material \"", m.name, "\": ", what, " must be between 0 and 1"));
      return value;
    };
    if (sheen) {
      const Rgb colour = rgb_at(*sheen, "sheenColorFactor").value_or(Rgb(0));
      for (int c = 0; c < 3; ++c) check(static_cast<double>(colour[c]), "sheenColorFactor");
      const double roughness = check(number_at(*sheen, "sheenRoughnessFactor", 0), "sheenRoughnessFactor");
      if (max_component(colour) > 0) lay_sheen(scene, m, colour, roughness);
    }
    if (coat) {
      const double factor = check(number_at(*coat, "clearcoatFactor", 0), "clearcoatFactor");
      const double roughness =
          check(number_at(*coat, "clearcoatRoughnessFactor", 0), "clearcoatRoughnessFactor");
      if (factor > 0) lay_coat(scene, m, static_cast<float>(factor), static_cast<float>(roughness));
    }
  }
}

}  // namespace phos::inline scene
