#include "scene/material/sharp_materials.h"

#include <algorithm>
#include <cmath>

#include "scene/material/bsdf.h"
#include "scene/material/models.h"
#include "scene/texture/texture.h"

namespace phos::inline scene {
namespace {

// Of this roughness, half of the lobe lies within 6 degrees about the mirror direction.
constexpr float kSharpAlpha = 0.1f;
constexpr float kSharpExponent = 200;

}  // namespace

bool reflects_as_mirror(const Material& m) {
  const GlossWidth gloss = gloss_width(m);
  return gloss.kind == GlossWidth::Kind::mirror ||
         (gloss.kind == GlossWidth::Kind::rough &&
          std::max(gloss.alpha_x, gloss.alpha_y) < Bsdf::kSmoothestAlpha);
}

bool reflects_sharply(const Material& m) {
  if (reflects_as_mirror(m)) return true;
  const GlossWidth gloss = gloss_width(m);
  if (gloss.kind == GlossWidth::Kind::exponent) return gloss.exponent > kSharpExponent;
  return gloss.kind == GlossWidth::Kind::rough && std::min(gloss.alpha_x, gloss.alpha_y) < kSharpAlpha;
}

float turned_share(const Scene& scene, std::uint32_t material) {
  const Vec3 slanted(std::sqrt(0.75f), 0, 0.5f);
  BsdfSample branch[2];
  const int branches = Bsdf(scene, material).specular_branches(slanted, branch);
  float share = 0;
  for (int b = 0; b < branches; ++b)
    if (!branch[b].straight) share += max_component(branch[b].weight);
  return share;
}

bool turns_light(const Scene& scene, std::uint32_t material) { return turned_share(scene, material) > 0; }

bool casts_caustics(const Scene& scene) {
  for (std::uint32_t m = 0; m < scene.material.size(); ++m)
    if (turns_light(scene, m)) return true;
  return false;
}

double lobe_hit_share(const Scene& scene, const Material& m) {
  const GlossWidth gloss = gloss_width(m);
  if (gloss.kind == GlossWidth::Kind::exponent) {
    const double n = static_cast<double>(gloss.exponent);
    return std::min(1.0, 2 * (2 * n + 1) / ((n + 1) * (n + 1)));
  }
  if (gloss.kind != GlossWidth::Kind::rough) return 1;
  double ax = static_cast<double>(gloss.alpha_x), ay = static_cast<double>(gloss.alpha_y);
  if (row_of(m).gltf_core) {  // its texture at its mean
    const double rough =
        std::clamp(static_cast<double>(m.roughness * mean_texel(scene, m.metallic_roughness).y), 0.0, 1.0);
    const double bent = static_cast<double>(m.anisotropy * m.anisotropy);
    ay = rough * rough, ax = ay + (1 - ay) * bent;
  }
  const auto smoothest = static_cast<double>(Bsdf::kSmoothestAlpha);
  if (std::max(ax, ay) < smoothest) return 1;  // a mirror, not a lobe
  return std::min(1.0, gloss.hit_factor * std::max(ax, smoothest) * std::max(ay, smoothest));
}

bool gathers_light(const Scene& scene) {
  constexpr float kFlat = 1 - 1e-6f;  // cosine of a vertex normal to its triangle's
  for (const Instance& instance : scene.instance) {
    const Material& m = scene.material[instance.material];
    if (!reflects_as_mirror(m)) continue;
    if (is_solid_glass(m) || m.normal.used()) return true;
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

}  // namespace phos::inline scene
