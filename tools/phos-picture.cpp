// phos-picture: makes a picture for people from an image of light.
#include "file/atomic_file.h"
#include "file/tool.h"
#include "image/false_colour.h"
#include "image/metrics.h"
#include "image/tone_map.h"

namespace phos {
namespace {

constexpr const char* kDescription =
    "Reads OpenEXR or Radiance .hdr and writes a PNG (sRGB), or Radiance .hdr where OUTPUT ends in .hdr. By "
    "default the "
    "light is tone mapped: the log-average luminance becomes a middle grey, the brightest half per cent "
    "becomes white, "
    "colours keep their hue. --false-colour shows luminance (cd/m2) or illuminance (lx) as colours, with a "
    "legend. Pixels "
    "that are not finite are magenta, and counted in a warning.";

enum class ScaleChoice { automatic, linear, logarithmic };

struct PictureOptions {
  std::string layer = "beauty";
  ToneOptions tone;
  bool false_colour = false;
  ScaleChoice scale = ScaleChoice::automatic;
  Palette palette = Palette::viridis;
  std::optional<double> min, max;
};

void declare_options(Options& o, PictureOptions& p) {
  o.text("layer", p.layer, "LAYER", "layer to show (beauty, indirect, illuminance, normal, ...)");
  o.section("Tone mapping");
  o.number("exposure", p.tone.exposure_ev, "EV", "stops brighter than automatic", {-60, 60});
  o.number("white", p.tone.white_cd_m2, "CD/M2", "luminance that becomes white; else the 99.5th percentile",
           kPositive);
  o.choice<ToneOperator>("operator", p.tone.curve,
                         {{"reinhard", ToneOperator::reinhard},
                          {"filmic", ToneOperator::filmic},
                          {"linear", ToneOperator::linear}},
                         "tone curve, on luminance");
  o.section("False colour");
  o.flag("false-colour", p.false_colour, "show amounts as colours, with a legend");
  o.choice<ScaleChoice>(
      "scale", p.scale,
      {{"auto", ScaleChoice::automatic}, {"linear", ScaleChoice::linear}, {"log", ScaleChoice::logarithmic}},
      "scale of the legend; auto: log for cd/m2, linear for the rest");
  o.number("min", p.min, "X", "amount at the low end, in the layer's unit; else automatic");
  o.number("max", p.max, "X", "amount at the high end; else the 98th percentile, rounded up");
  o.choice<Palette>("palette", p.palette,
                    {{"viridis", Palette::viridis}, {"turbo", Palette::turbo}, {"grey", Palette::grey}},
                    "colours: even in lightness, most colours, or none");
}

/// The layer as colours: itself, grey of a single quantity, or directions as 0.5 + 0.5 n.
std::vector<Rgb> colours_of(const Image& image, const std::string& layer) {
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

std::string title_of(const std::string& layer) {
  if (layer.empty()) return "luminance";
  return layer == "illuminance" || layer_unit(layer) != "cd/m2" ? layer : "luminance, " + layer;
}

std::size_t write_false_colour(const std::string& path, const Image& image, const std::string& layer,
                               const PictureOptions& p) {
  const std::vector<float> values = layer_values(image, layer);
  const std::string unit = layer_unit(layer);
  const bool log = p.scale == ScaleChoice::automatic ? unit == "cd/m2" : p.scale == ScaleChoice::logarithmic;
  const FalseColourRange range =
      false_colour_range(values, log ? Scale::logarithmic : Scale::linear, p.min, p.max);
  write_png(path,
            false_colour(values, image.width(), image.height(), range, p.palette, title_of(layer), unit));
  std::size_t non_finite = 0;
  for (const float v : values) non_finite += std::isfinite(v) ? 0 : 1;
  return non_finite;
}

std::size_t write_hdr_layer(const std::string& path, const Image& image, const std::vector<Rgb>& colours) {
  Image out(image.width(), image.height());
  out.attributes = image.attributes;
  out.set_rgb("", colours);
  write_hdr(path, out);
  std::size_t non_finite = 0;
  for (const Rgb& c : colours) non_finite += is_finite(c) ? 0 : 1;
  return non_finite;
}

std::size_t write_tone_mapped(const Tool& tool, const Image& image, const std::vector<Rgb>& colours,
                              bool directions, ToneOptions tone) {
  if (directions) tone = {ToneOperator::linear, tone.exposure_ev, 1.0};
  const ToneMapped mapped = tone_map(colours, image.width(), image.height(), tone);
  write_png(tool.output(), mapped.picture);
  if (tool.verbose())
    tool.say(
        text("log-average luminance ", mapped.key_cd_m2, " cd/m2, white ", mapped.white_cd_m2, " cd/m2"));
  return mapped.non_finite;
}

int main_of_tool(int argc, const char* const* argv) {
  Tool tool("phos-picture",
            "makes a picture from an image of light: tone mapped, or false colour with a legend",
            kDescription, 1);
  tool.output_has_no_key();
  std::string input;
  PictureOptions p;
  tool.options().input("IMAGE", input, "OpenEXR or Radiance .hdr");
  declare_options(tool.options(), p);
  tool.options().example("phos-picture room.exr -o room.png", "as a camera would see it");
  tool.options().example("phos-picture room.exr -o lux.png --layer illuminance --false-colour --max 1000",
                         "lux on every surface");

  return tool.run(argc, argv, [&] {
    const bool hdr = tool.output().ends_with(".hdr");
    if (!hdr && !tool.output().ends_with(".png"))
      throw Error(ExitCode::usage, "--output", "the name must end in .png or .hdr");
    if (hdr && p.false_colour)
      throw Error(ExitCode::usage, "--false-colour", "false colours need an output that ends in .png");
    require_writable(tool.output());
    tool.add_input("image", input);
    const Image image = read_image(input);
    const std::string layer = layer_from_label(p.layer);
    std::size_t non_finite = 0;
    if (p.false_colour) {
      non_finite = write_false_colour(tool.output(), image, layer, p);
    } else {
      const std::vector<Rgb> colours = colours_of(image, layer);
      const bool directions = image.has(channel_name(layer, "X"));
      non_finite = hdr ? write_hdr_layer(tool.output(), image, colours)
                       : write_tone_mapped(tool, image, colours, directions, p.tone);
    }
    if (non_finite == 0) return;
    tool.counters().count("non-finite pixel", non_finite);
    tool.warn(text(input, ": ", non_finite, " of ", image.pixels(), " pixels are not finite; they are ",
                   hdr ? "black" : "magenta"));
  });
}

}  // namespace
}  // namespace phos

int main(int argc, char** argv) { return phos::main_of_tool(argc, argv); }
