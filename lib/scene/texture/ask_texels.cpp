#include "scene/texture/ask_texels.h"

#include <cmath>

#include "scene/texture/texture.h"

namespace phos::inline scene {
namespace {

constexpr std::size_t kLarge = std::size_t{1} << 14;  // texels

/// Where a repeated texture has its coordinates; of others, and beside an edge, it only misses.
std::size_t texel_at(float t, int size) {
  const float scaled = (t - static_cast<float>(static_cast<int>(t))) * static_cast<float>(size);
  const int i = static_cast<int>(scaled < 0 ? scaled + static_cast<float>(size) : scaled);
  return static_cast<std::size_t>(std::min(i, size - 1));
}

void ask(const Scene& scene, const TextureUse& use, const SurfacePoint& point) {
  if (!use.used()) return;
  const Texture& texture = scene.texture[static_cast<std::size_t>(use.texture)];
  if (texture.size() < kLarge || texture.width <= 0 || texture.height <= 0) return;
  const Vec2 uv = transformed(use, use.set == 0 ? point.uv0 : point.uv1);
  if (!(std::fabs(uv.x) < 0x1p23f && std::fabs(uv.y) < 0x1p23f)) return;
  const std::size_t width = static_cast<std::size_t>(texture.width);
  const std::size_t i = texel_at(uv.y, texture.height) * width + texel_at(uv.x, texture.width);
  const std::size_t below = std::min(i + width, texture.size() - 1);
  if (!texture.texels.empty()) {
    __builtin_prefetch(&texture.texels[i]), __builtin_prefetch(&texture.texels[below]);
  } else {
    __builtin_prefetch(&texture.codes[i]), __builtin_prefetch(&texture.codes[below]);
  }
}

}  // namespace

void ask_texels(const Scene& scene, const SurfacePoint& point) {
  const Material& material = scene.material[point.material];
  ask(scene, material.base_colour, point);
  ask(scene, material.metallic_roughness, point);
}

}  // namespace phos::inline scene
