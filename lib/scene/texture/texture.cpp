#include "scene/texture/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/texture/visible_share.h"

namespace phos::inline scene {

namespace {

/// Value of each 8-bit code.
struct Decoded {
  std::array<float, 256> value;
  explicit Decoded(bool srgb) {
    for (int i = 0; i < 256; ++i) value[static_cast<std::size_t>(i)] = decode_channel(i, 255, srgb);
  }
};
const Decoded kLinear(false), kSrgb(true);

/// t - floor(t); 0 for a t that is not finite. (std::floor is a call on the oldest x86.)
float fraction(float t) {
  if (!std::isless(std::fabs(t), 0x1p23f)) return 0;  // whole
  const float truncated = static_cast<float>(static_cast<int>(t));
  return t - (truncated > t ? truncated - 1 : truncated);
}

/// Maps a coordinate into [0,1]; 0 for one that is not finite.
float wrapped(float t, Texture::Wrap wrap) {
  switch (wrap) {
    case Texture::Wrap::clamp:
      return std::isfinite(t) ? std::clamp(t, 0.f, 1.f) : 0.f;
    case Texture::Wrap::mirror: {
      const float period = 2 * fraction(0.5f * t);
      return period > 1.f ? 2.f - period : period;
    }
    case Texture::Wrap::repeat:
      break;
  }
  return fraction(t);
}

/// Index of a texel that may lie one beyond either end.
int wrapped_texel(int i, int n, Texture::Wrap wrap) {
  if (wrap == Texture::Wrap::repeat) return i < 0 ? i + n : (i >= n ? i - n : i);
  return std::clamp(i, 0, n - 1);  // mirrored, the neighbour of an end texel is itself
}

}  // namespace

float decode_channel(int code, int largest, bool srgb) {
  const float v = static_cast<float>(code) / static_cast<float>(largest);
  if (!srgb) return v;
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);  // IEC 61966-2-1
}

Vec4 Texture::texel(std::size_t i) const {
  if (!texels.empty()) return texels[i];
  const Code& c = codes[i];
  const std::array<float, 256>& colour = (srgb ? kSrgb : kLinear).value;
  return {colour[c[0]], colour[c[1]], colour[c[2]], kLinear.value[c[3]]};
}

Vec4 Texture::at(const Vec2& uv) const {
  if (width <= 0 || height <= 0 || size() == 0) return Vec4(1);
  const float x = wrapped(uv.x, wrap_u) * static_cast<float>(width);
  const float y = wrapped(uv.y, wrap_v) * static_cast<float>(height);
  const auto there = [&](int i, int j) {
    return texel(static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i));
  };
  if (nearest) {
    return there(std::min(static_cast<int>(x), width - 1), std::min(static_cast<int>(y), height - 1));
  }
  const int x0 = static_cast<int>(x + 0.5f) - 1, y0 = static_cast<int>(y + 0.5f) - 1;
  const float fx = x - 0.5f - static_cast<float>(x0), fy = y - 0.5f - static_cast<float>(y0);
  const int i0 = wrapped_texel(x0, width, wrap_u), i1 = wrapped_texel(x0 + 1, width, wrap_u);
  const int j0 = wrapped_texel(y0, height, wrap_v), j1 = wrapped_texel(y0 + 1, height, wrap_v);
  const Vec4 top = (1 - fx) * there(i0, j0) + fx * there(i1, j0);
  const Vec4 bottom = (1 - fx) * there(i0, j1) + fx * there(i1, j1);
  return (1 - fy) * top + fy * bottom;
}

Vec2 transformed(const TextureUse& use, const Vec2& uv) {
  const Vec2 scaled = use.scale * uv;
  if (use.rotation_rad == 0) return scaled + use.offset;
  // Counter-clockwise as seen with v pointing down.
  const float c = std::cos(use.rotation_rad), s = std::sin(use.rotation_rad);
  return Vec2(c * scaled.x + s * scaled.y, -s * scaled.x + c * scaled.y) + use.offset;
}

Vec4 look_up(const Scene& scene, const TextureUse& use, const Vec2& uv0, const Vec2& uv1) {
  if (!use.used()) return Vec4(1);
  return scene.texture[static_cast<std::size_t>(use.texture)].at(transformed(use, use.set == 0 ? uv0 : uv1));
}

Vec4 mean_texel(const Scene& scene, const TextureUse& use) {
  if (!use.used()) return Vec4(1);
  const Texture& texture = scene.texture[static_cast<std::size_t>(use.texture)];
  if (texture.size() == 0) return Vec4(1);
  glm::dvec4 sum(0);
  for (std::size_t i = 0; i < texture.size(); ++i) sum += glm::dvec4(texture.texel(i));
  return Vec4(sum / static_cast<double>(texture.size()));
}

Vec2 texture_coordinates(const Scene& scene, std::uint32_t triangle, int set, float u, float v) {
  const std::vector<Vec2>& uv = set == 0 ? scene.uv0 : scene.uv1;
  if (uv.empty()) return Vec2(0);
  const auto& corner = scene.triangle[triangle].v;
  return (1 - u - v) * uv[corner[0]] + u * uv[corner[1]] + v * uv[corner[2]];
}

Rgb emission_at(const Scene& scene, std::uint32_t triangle, float u, float v) {
  const Material& material = scene.material_of(triangle);
  const float share = visible_share(scene, triangle, u, v);
  if (!material.emissive.used()) return share * material.emission;
  const Vec2 uv = texture_coordinates(scene, triangle, material.emissive.set, u, v);
  return share * material.emission * Rgb(look_up(scene, material.emissive, uv, uv));
}

}  // namespace phos::inline scene
