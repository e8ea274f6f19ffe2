#include "view/scene_textures.h"

#include <algorithm>
#include <cmath>

namespace phos::inline view {
namespace {

using Numbers = std::vector<std::uint32_t>;

std::uint8_t code_of(float linear, bool srgb) {
  const float v = std::clamp(linear, 0.f, 1.f);
  const float shown = !srgb             ? v
                      : v <= 0.0031308f ? 12.92f * v
                                        : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;  // IEC 61966-2-1
  return static_cast<std::uint8_t>(255 * shown + 0.5f);
}

/// A texture whose sides are divided by `step`.
struct Sent {
  const Texture* texture;
  int step = 1;
  int width() const { return (texture->width + step - 1) / step; }
  int height() const { return (texture->height + step - 1) / step; }
  std::size_t side() const { return static_cast<std::size_t>(std::max(width(), height())); }
  std::size_t size() const { return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()); }
};

std::vector<Sent> fitted(const std::vector<const Texture*>& used, const TextureLimits& most) {
  std::vector<Sent> all;
  std::size_t texels = 0;
  for (const Texture* t : used) {
    Sent& sent = all.emplace_back(Sent{t});
    while (sent.side() > most.side) sent.step *= 2;
    texels += sent.size();
  }
  while (texels > most.all) {
    const auto largest = std::max_element(all.begin(), all.end(),
                                          [](const Sent& a, const Sent& b) { return a.size() < b.size(); });
    if (largest->size() == 1) break;
    texels -= largest->size();
    largest->step *= 2;
    texels += largest->size();
  }
  return all;
}

/// Mean of a block, linear.
Vec4 mean_of(const Sent& sent, int x0, int y0) {
  const Texture& t = *sent.texture;
  Vec4 sum(0);
  float n = 0;
  for (int y = y0; y < std::min(y0 + sent.step, t.height); ++y)
    for (int x = x0; x < std::min(x0 + sent.step, t.width); ++x, ++n)
      sum += t.texel(static_cast<std::size_t>(y) * static_cast<std::size_t>(t.width) +
                     static_cast<std::size_t>(x));
  return sum / n;
}

void add_texels(const Sent& sent, bool srgb, std::vector<std::uint8_t>& rgba) {
  const Texture& t = *sent.texture;
  if (sent.step == 1 && t.texels.empty()) {
    for (const Texture::Code& code : t.codes) rgba.insert(rgba.end(), code.begin(), code.end());
    return;
  }
  for (int y = 0; y < t.height; y += sent.step)
    for (int x = 0; x < t.width; x += sent.step) {
      const Vec4 mean = mean_of(sent, x, y);
      for (int c = 0; c < 4; ++c) rgba.push_back(code_of(mean[c], srgb && c < 3));
    }
}

}  // namespace

std::uint32_t SceneTextures::row(const TextureUse& use) {
  if (!use.used() || scene_.texture[static_cast<std::size_t>(use.texture)].size() == 0) return kNoRow;
  const auto [found, first] = row_.emplace(use.texture, static_cast<std::uint32_t>(used_.size()));
  if (first) used_.push_back(&scene_.texture[static_cast<std::size_t>(use.texture)]);
  return found->second;
}

std::size_t SceneTextures::add_to(MessageWriter& message) const {
  Numbers width, height, wrap, nearest, srgb, first;
  std::vector<std::uint8_t> rgba;
  std::size_t reduced = 0;
  for (const Sent& sent : fitted(used_, most_)) {
    reduced += sent.step > 1 ? 1 : 0;
    const Texture& texture = *sent.texture;
    const bool coded = texture.srgb || !texture.texels.empty();
    width.push_back(static_cast<std::uint32_t>(sent.width()));
    height.push_back(static_cast<std::uint32_t>(sent.height()));
    wrap.push_back(static_cast<std::uint32_t>(texture.wrap_u));
    wrap.push_back(static_cast<std::uint32_t>(texture.wrap_v));
    nearest.push_back(texture.nearest ? 1 : 0);
    srgb.push_back(coded ? 1 : 0);
    first.push_back(static_cast<std::uint32_t>(rgba.size() / 4));
    add_texels(sent, coded, rgba);
  }
  message.add("texture", "width", width);
  message.add("texture", "height", height);
  message.add("texture", "wrap", wrap);
  message.add("texture", "nearest", nearest);
  message.add("texture", "srgb", srgb);
  message.add("texture", "first_texel", first);
  message.add("texel", "rgba", rgba);
  return reduced;
}

}  // namespace phos::inline view
