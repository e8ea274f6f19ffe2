// phos-picture: makes a picture for people from an image of light, or a plot from a table.
#include "file/atomic_file.h"
#include "file/tool.h"
#include "image/csv_plot.h"
#include "image/layer_picture.h"
#include "image/metrics.h"

namespace phos {
namespace {

constexpr const char* kDescription =
    "Reads OpenEXR or Radiance .hdr and writes a PNG (sRGB), or Radiance .hdr where OUTPUT ends in .hdr. By "
    "default the light is tone mapped: the log-average luminance becomes a middle grey, the brightest half "
    "per cent becomes white, colours keep their hue. --false-colour shows luminance (cd/m2) or illuminance "
    "(lx) as colours, with a legend. Pixels that are not finite are magenta, and counted in a warning. From "
    "a table (comma-separated values with a line of names) it draws lines, --y over --x, as SVG or PNG.";

/// The name says what is written, the content of the input what can be.
void check_output(const std::string& output, const std::string& input, bool image) {
  if (image && output.ends_with(".svg"))
    throw Error(ExitCode::usage, "--output", text(input, " is an image; the name must end in .png or .hdr"));
  if (!image && output.ends_with(".hdr"))
    throw Error(ExitCode::usage, "--output", text(input, " is a table; the name must end in .svg or .png"));
}

void draw_plot(Tool& tool, const std::string& bytes, const std::string& input,
               const CsvPlotOptions& options) {
  const CsvTable table = parse_csv(bytes, input);
  if (options.x.empty() || options.y.empty())
    throw Error(ExitCode::usage, options.x.empty() ? "--x" : "--y",
                text("name a column of ", input, ": ", table.names()));
  const Plot plot = plot_of(table, options);
  if (tool.output().ends_with(".svg")) {
    AtomicFile file(tool.output());
    file.write(plot_svg(plot));
    file.commit();
  } else {
    constexpr int kScale = 2;
    write_png(tool.output(), plot_picture(plot, kScale));
  }
  if (const std::size_t n = points_left_out(plot); n > 0) {
    tool.counters().count("point that cannot be shown", n);
    tool.warn(text(input, ": ", n, " points are left out: not finite, or not above 0 on a logarithmic axis"));
  }
}

std::size_t write_hdr_layer(const std::string& path, const Image& image, const std::string& layer) {
  const std::vector<Rgb> colours = layer_colours(image, layer);
  Image out(image.width(), image.height());
  out.attributes = image.attributes;
  out.set_rgb("", colours);
  write_hdr(path, out);
  std::size_t non_finite = 0;
  for (const Rgb& c : colours) non_finite += is_finite(c) ? 0 : 1;
  return non_finite;
}

void show_image(Tool& tool, const Image& image, const std::string& input, const LayerPictureOptions& p) {
  const bool hdr = tool.output().ends_with(".hdr");
  std::size_t non_finite = 0;
  if (hdr) {
    non_finite = write_hdr_layer(tool.output(), image, layer_from_label(p.layer));
  } else {
    const ToneMapped shown = layer_picture(image, p);
    write_png(tool.output(), shown.picture);
    non_finite = shown.non_finite;
    if (tool.verbose() && !p.false_colour)
      tool.say(
          text("log-average luminance ", shown.key_cd_m2, " cd/m2, white ", shown.white_cd_m2, " cd/m2"));
  }
  if (non_finite == 0) return;
  tool.counters().count("non-finite pixel", non_finite);
  tool.warn(text(input, ": ", non_finite, " of ", image.pixels(), " pixels are not finite; they are ",
                 hdr ? "black" : "magenta"));
}

int main_of_tool(int argc, const char* const* argv) {
  Tool tool("phos-picture", "makes a picture from an image of light, or a plot from a table", kDescription,
            1);
  tool.output_has_no_key();
  std::string input;
  LayerPictureOptions picture;
  CsvPlotOptions plot;
  Options& options = tool.options();
  options.input("INPUT", input, "OpenEXR, Radiance .hdr, or a table (CSV)");
  declare_options(options, picture);
  declare_options(options, plot);
  options.example("phos-picture room.exr -o room.png", "as a camera would see it");
  options.example("phos-picture room.exr -o lux.png --layer illuminance --false-colour --max 1000",
                  "lux on every surface");
  options.example(
      "phos-picture errors.csv --x seconds --y rmse --series method --log-x --log-y -o errors.svg",
      "a line for each method");

  return tool.run(argc, argv, [&] {
    const std::string& output = tool.output();
    if (!output.ends_with(".png") && !output.ends_with(".hdr") && !output.ends_with(".svg"))
      throw Error(ExitCode::usage, "--output", "the name must end in .png, .hdr or .svg");
    if (picture.false_colour && output.ends_with(".hdr"))
      throw Error(ExitCode::usage, "--false-colour", "false colours need an output that ends in .png");
    require_writable(output);
    tool.add_input("input", input);
    const std::string bytes = read_text(input);
    if (!is_image(bytes) && is_plain_text(bytes)) {
      check_output(output, input, false);
      draw_plot(tool, bytes, input, plot);
      return;
    }
    const Image image = read_image(input);
    check_output(output, input, true);
    if (const std::string option = given_plot_option(options); !option.empty())
      throw Error(ExitCode::usage, "--" + option, text("is for tables; ", input, " is an image"));
    show_image(tool, image, input, picture);
  });
}

}  // namespace
}  // namespace phos

int main(int argc, char** argv) { return phos::main_of_tool(argc, argv); }
