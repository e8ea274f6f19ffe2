#include "scene/obj/coverage_texture.h"

#include <algorithm>
#include <cmath>

namespace phos::inline scene {
namespace {

/// A band of one texel across one along would take the memory of a square.
constexpr std::int64_t kMostPixels = 1 << 26;

float coverage_of(const Vec4& texel, CoverageOf channel) {
  switch (channel) {
    case CoverageOf::red:
      return texel.x;
    case CoverageOf::green:
      return texel.y;
    case CoverageOf::blue:
      return texel.z;
    case CoverageOf::luminance:
      return luminance(Rgb(texel));
    case CoverageOf::alpha_or_luminance:
      break;
  }
  return texel.w;
}

/// Texel (i, j) of a grid of that size over the texture.
Vec4 resampled(const Texture& t, int i, int j, int width, int height) {
  if (t.width == width && t.height == height)
    return t.texel(static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(i));
  return t.at({(static_cast<float>(i) + 0.5f) / static_cast<float>(width),
               (static_cast<float>(j) + 0.5f) / static_cast<float>(height)});
}

std::uint8_t code_of(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

}  // namespace

bool has_alpha(const Texture& texture) {
  for (std::size_t i = 0; i < texture.size(); ++i)
    if (texture.texel(i).w < 1) return true;
  return false;
}

Texture with_coverage(const Texture* colour, const Texture& coverage, CoverageOf channel) {
  if (channel == CoverageOf::alpha_or_luminance && !has_alpha(coverage)) channel = CoverageOf::luminance;
  const Texture& sampling = colour ? *colour : coverage;
  Texture out;
  out.name = colour ? colour->name + " with " + coverage.name : coverage.name;
  out.wrap_u = sampling.wrap_u, out.wrap_v = sampling.wrap_v, out.nearest = sampling.nearest;
  out.width = std::max(coverage.width, colour ? colour->width : 0);
  out.height = std::max(coverage.height, colour ? colour->height : 0);
  if (colour && static_cast<std::int64_t>(out.width) * out.height > kMostPixels) {
    const Texture& larger = colour->size() > coverage.size() ? *colour : coverage;
    out.width = larger.width, out.height = larger.height;
  }
  // Codes where none of the colours has to be computed anew.
  const bool as_codes =
      coverage.texels.empty() &&
      (!colour || (colour->texels.empty() && colour->width == out.width && colour->height == out.height));
  const std::size_t n = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  out.srgb = as_codes && colour && colour->srgb;
  if (as_codes)
    out.codes = colour ? colour->codes : std::vector<Texture::Code>(n, {255, 255, 255, 255});
  else
    out.texels.resize(n, Vec4(1));
  for (std::size_t k = 0; k < n; ++k) {
    const int i = static_cast<int>(k % static_cast<std::size_t>(out.width));
    const int j = static_cast<int>(k / static_cast<std::size_t>(out.width));
    const float share = coverage_of(resampled(coverage, i, j, out.width, out.height), channel);
    if (as_codes) {
      out.codes[k][3] = code_of(share);
    } else {
      if (colour) out.texels[k] = resampled(*colour, i, j, out.width, out.height);
      out.texels[k].w = share;
    }
  }
  return out;
}

Texture without_alpha(const Texture& colour) {
  Texture out = colour;
  for (Texture::Code& code : out.codes) code[3] = 255;
  for (Vec4& texel : out.texels) texel.w = 1;
  return out;
}

}  // namespace phos::inline scene
