#include "image/layer_picture.h"

#include <algorithm>
#include <cmath>

#include "image/metrics.h"

namespace phos::inline image {

namespace {

std::string title_of(const std::string& layer) {
  if (layer.empty()) return "luminance";
  return layer == "illuminance" || layer_unit(layer) != "cd/m2" ? layer : "luminance, " + layer;
}

FalseColourRange range_of(std::span<const float> values, const std::string& unit,
                          const LayerPictureOptions& p) {
  const bool log = p.scale == ScaleChoice::automatic ? unit == "cd/m2" : p.scale == ScaleChoice::logarithmic;
  return false_colour_range(values, log ? Scale::logarithmic : Scale::linear, p.min, p.max);
}

ToneMapped false_colours(const Image& image, const std::string& layer, const LayerPictureOptions& p) {
  const std::vector<float> values = layer_values(image, layer);
  const std::string unit = layer_unit(layer);
  ToneMapped out;
  out.picture = false_colour(values, image.width(), image.height(), range_of(values, unit, p), p.palette,
                             title_of(layer), unit, p.steady);
  for (const float v : values) out.non_finite += std::isfinite(v) ? 0 : 1;
  return out;
}

/// Is the layer one of directions, which are colours as they are?
bool has_directions(const Image& image, const std::string& layer) {
  return image.has(channel_name(layer, "X"));
}

}  // namespace

void declare_options(Options& o, LayerPictureOptions& p) {
  o.text("layer", p.layer, "LAYER", "layer to show (beauty, indirect, illuminance, normal, ...)");
  o.section("Tone mapping");
  o.number("exposure", p.tone.exposure_ev, "EV",
           "stops brighter than the automatic exposure; below 0: darker", {-60, 60});
  o.number("white", p.tone.white_cd_m2, "CD/M2",
           "luminance that becomes white (default: the 99.5th percentile)", kPositive);
  o.number("key", p.tone.key_cd_m2, "CD/M2",
           "luminance that becomes a middle grey (default: the log average)", kPositive);
  o.choice<ToneOperator>("operator", p.tone.curve,
                         {{"reinhard", ToneOperator::reinhard},
                          {"filmic", ToneOperator::filmic},
                          {"linear", ToneOperator::linear}},
                         "tone curve, applied to luminance");
  o.section("False colour");
  o.flag("false-colour", p.false_colour, "show values as colours, with a legend");
  o.choice<ScaleChoice>(
      "scale", p.scale,
      {{"auto", ScaleChoice::automatic}, {"linear", ScaleChoice::linear}, {"log", ScaleChoice::logarithmic}},
      "scale of the legend; auto: log for cd/m2, linear for the rest");
  o.number("min", p.min, "X", "value at the low end of the legend, in the layer's unit (default: automatic)");
  o.number(
      "max", p.max, "X",
      "value at the high end of the legend, in the layer's unit (default: the 98th percentile, rounded up)");
  o.choice<Palette>(
      "palette", p.palette,
      {{"viridis", Palette::viridis}, {"turbo", Palette::turbo}, {"grey", Palette::grey}},
      "colours of the legend: viridis: even in lightness; turbo: most colours; grey: no colours");
}

std::string given_picture_option(const Options& options) {
  return options.first_given(
      {"layer", "exposure", "white", "key", "operator", "false-colour", "scale", "min", "max", "palette"});
}

std::vector<Rgb> layer_colours(const Image& image, const std::string& layer) {
  if (image.has_layer(layer)) return image.rgb(layer);
  std::vector<Rgb> colours(image.pixels());
  if (components_of(image, layer) == std::vector<std::string>{"X", "Y", "Z"}) {
    for (int c = 0; c < 3; ++c) {
      const std::span<const float> v =
          image.channel(channel_name(layer, std::string(1, static_cast<char>('X' + c))));
      for (std::size_t i = 0; i < v.size(); ++i) colours[i][c] = 0.5f + 0.5f * v[i];
    }
    return colours;
  }
  const std::vector<float> values = layer_values(image, layer);
  for (std::size_t i = 0; i < values.size(); ++i) colours[i] = Rgb(values[i]);
  return colours;
}

LayerPictureOptions fixed_exposure(const Image& image, const LayerPictureOptions& p) {
  const std::string layer = layer_from_label(p.layer);
  LayerPictureOptions fixed = p;
  if (!p.false_colour) {
    if (!has_directions(image, layer)) fixed.tone = fixed_exposure(layer_colours(image, layer), p.tone);
    return fixed;
  }
  const std::vector<float> values = layer_values(image, layer);
  if (std::none_of(values.begin(), values.end(), [](float v) { return std::isfinite(v) && v != 0; }))
    return fixed;
  const FalseColourRange range = range_of(values, layer_unit(layer), p);
  fixed.min = range.lo, fixed.max = range.hi;
  return fixed;
}

ToneMapped layer_picture(const Image& image, const LayerPictureOptions& p) {
  const std::string layer = layer_from_label(p.layer);
  if (p.false_colour) return false_colours(image, layer, p);
  const ToneOptions tone = has_directions(image, layer)
                               ? ToneOptions{ToneOperator::linear, p.tone.exposure_ev, 1.0, std::nullopt}
                               : p.tone;
  return tone_map(layer_colours(image, layer), image.width(), image.height(), tone);
}

}  // namespace phos::inline image
