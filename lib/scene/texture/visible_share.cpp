#include "scene/texture/visible_share.h"

#include <algorithm>

#include "scene/texture/texture.h"

namespace phos::inline scene {

float alpha_at(const Scene& scene, std::uint32_t triangle, float u, float v) {
  const Material& material = scene.material_of(triangle);
  float alpha = material.alpha;
  if (material.base_colour.used()) {
    const Vec2 uv = texture_coordinates(scene, triangle, material.base_colour.set, u, v);
    alpha *= look_up(scene, material.base_colour, uv, uv).w;
  }
  if (!scene.colour.empty()) {
    const auto& corner = scene.triangle[triangle].v;
    alpha *= (1 - u - v) * scene.colour[corner[0]].w + u * scene.colour[corner[1]].w +
             v * scene.colour[corner[2]].w;
  }
  return alpha;
}

float visible_share(const Scene& scene, std::uint32_t triangle, float u, float v) {
  const Material& material = scene.material_of(triangle);
  if (material.alpha_mode == Material::Alpha::opaque) return 1;
  const float alpha = alpha_at(scene, triangle, u, v);
  if (material.alpha_mode == Material::Alpha::mask) return alpha < material.alpha_cutoff ? 0.f : 1.f;
  return std::clamp(alpha, 0.f, 1.f);
}

float visible_share(const Scene& scene, const SurfacePoint& point) {
  const Material& material = scene.material[point.material];
  if (material.alpha_mode != Material::Alpha::blend) return 1;
  const float texel = look_up(scene, material.base_colour, point.uv0, point.uv1).w;
  return std::clamp(material.alpha * texel * point.colour.w, 0.f, 1.f);
}

}  // namespace phos::inline scene
