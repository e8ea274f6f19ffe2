#include "scene/sharp_materials.h"

#include <algorithm>
#include <cmath>

#include "scene/bsdf.h"

namespace phos {
namespace {

// Of this roughness, half of the lobe lies within 6 degrees about the mirror direction.
constexpr float kSharpAlpha = 0.1f;
constexpr float kSharpExponent = 200;

}  // namespace

bool reflects_as_mirror(const Material& m) {
  const auto smooth = [](float alpha_x, float alpha_y) {
    return std::max(alpha_x, alpha_y) < Bsdf::kSmoothestAlpha;
  };
  switch (m.model) {
    case Model::mirror:
    case Model::ward:
      return max_component(m.ks) > 0 && (m.model == Model::mirror || smooth(m.alpha_x, m.alpha_y));
    case Model::dielectric:
    case Model::thin_dielectric:
      return m.ior != 1;
    case Model::conductor:
    case Model::plastic:
      return smooth(m.alpha_x, m.alpha_y);
    case Model::metallic_roughness:
      return m.roughness * m.roughness < Bsdf::kSmoothestAlpha && (m.specular > 0 || m.metallic > 0);
    default:
      return false;
  }
}

bool reflects_sharply(const Material& m) {
  if (reflects_as_mirror(m)) return true;
  switch (m.model) {
    case Model::phong:
      return max_component(m.ks) > 0 && m.exponent > kSharpExponent;
    case Model::ward:
      return max_component(m.ks) > 0 && std::min(m.alpha_x, m.alpha_y) < kSharpAlpha;
    case Model::conductor:
    case Model::plastic:
      return std::min(m.alpha_x, m.alpha_y) < kSharpAlpha;
    case Model::metallic_roughness:
      return m.roughness * m.roughness < kSharpAlpha && (m.specular > 0 || m.metallic > 0);
    default:
      return false;
  }
}

bool gathers_light(const Scene& scene) {
  constexpr float kFlat = 1 - 1e-6f;  // cosine of a vertex normal to its triangle's
  for (const Instance& instance : scene.instance) {
    const Material& m = scene.material[instance.material];
    if (!reflects_as_mirror(m)) continue;
    if (m.model == Model::dielectric || m.normal.used()) return true;
    for (std::uint32_t t = instance.first_triangle; t < instance.first_triangle + instance.triangle_count;
         ++t) {
      const Vec3 n = geometric_normal(scene, t);
      for (const std::uint32_t v : scene.triangle[t].v)
        if (n != Vec3(0) && std::fabs(glm::dot(scene.normal[v], n)) < kFlat) return true;
    }
  }
  return false;
}

bool has_caustic_ways(const Scene& scene) {
  return !scene.light.empty() &&
         std::any_of(scene.instance.begin(), scene.instance.end(),
                     [&](const Instance& i) { return reflects_sharply(scene.material[i.material]); });
}

}  // namespace phos
