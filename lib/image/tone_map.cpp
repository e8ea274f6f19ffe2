#include "image/tone_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "image/false_colour.h"

namespace phos::inline image {

namespace {

constexpr double kMiddleGrey = 0.18;

struct Levels {
  double key = 0, white = 0;
};

/// Log-average (Reinhard eq. 1) and 99.5th percentile. Luminances more than 1e4 below white count as that, in
/// place of the paper's offset, which depends on the unit.
Levels measure_levels(std::span<const Rgb> values) {
  std::vector<float> y;
  for (const Rgb& v : values)
    if (is_finite(v) && luminance(v) > 0) y.push_back(luminance(v));
  if (y.empty()) return {};
  const auto at = y.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(y.size() - 1) + 0.5);
  std::nth_element(y.begin(), at, y.end());
  const double white = *at;
  double sum = 0;
  for (const float v : y) sum += std::log(std::max(double{v}, 1e-4 * white));
  return {std::exp(sum / static_cast<double>(y.size())), white};
}

double hable(double x) {
  constexpr double a = 0.15, b = 0.50, c = 0.10, d = 0.20, e = 0.02, f = 0.30;
  return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

/// Display luminance of scene luminance, both relative to the key times middle grey; `white` becomes 1.
double curve(ToneOperator which, double x, double white) {
  switch (which) {
    case ToneOperator::reinhard:
      return x * (1 + x / (white * white)) / (1 + x);
    case ToneOperator::filmic:
      return hable(4 * x) / hable(4 * white);
    case ToneOperator::linear:
      break;
  }
  return x / white;
}

/// Colour of luminance `shown`, with the ratios of `c`, mixed with grey until no component exceeds 1.
Rgb in_gamut(Rgb c, double shown) {
  c = glm::max(c, Rgb(0));
  const float y = luminance(c);
  if (!(y > 0)) return Rgb(0);
  const float grey = static_cast<float>(std::min(shown, 1.0));
  c *= grey / y;
  const float most = max_component(c);
  if (most <= 1) return c;
  return Rgb(grey) + (1 - grey) / (most - grey) * (c - Rgb(grey));
}

}  // namespace

ToneOptions fixed_exposure(std::span<const Rgb> values, const ToneOptions& options) {
  if (options.key_cd_m2 && options.white_cd_m2) return options;
  const Levels levels = measure_levels(values);
  ToneOptions fixed = options;
  const double key = options.key_cd_m2.value_or(levels.key);
  if (!(key > 0)) return fixed;
  fixed.key_cd_m2 = key;
  // Below 1 relative to the key, Reinhard's curve would darken values that are white already.
  if (!options.white_cd_m2) fixed.white_cd_m2 = std::max(levels.white, key / kMiddleGrey);
  return fixed;
}

ToneMapped tone_map(std::span<const Rgb> values, int width, int height, const ToneOptions& options) {
  const ToneOptions fixed = fixed_exposure(values, options);
  ToneMapped out;
  out.picture = make_picture(width, height, kNotFinite);
  out.key_cd_m2 = fixed.key_cd_m2.value_or(0);
  out.white_cd_m2 = fixed.white_cd_m2.value_or(0);
  const double to_relative = fixed.key_cd_m2 ? kMiddleGrey / *fixed.key_cd_m2 : 0.0;
  const double white = out.white_cd_m2 * to_relative;
  const double gain = std::exp2(options.exposure_ev);
  for (const Rgb& v : values) out.non_finite += is_finite(v) ? 0 : 1;
  parallel_for(values.size(), 8192, [&](std::size_t i) {
    const Rgb& v = values[i];
    if (!is_finite(v)) return;
    const double x = gain * to_relative * std::max(0.0f, luminance(glm::max(v, Rgb(0))));
    const Colour8 c = x > 0 ? to_srgb(in_gamut(v, curve(options.curve, x, white))) : Colour8{};
    std::copy(c.begin(), c.end(), out.picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
  });
  return out;
}

}  // namespace phos::inline image
