// phos-picture: makes a picture for people from an image of light, or a plot from a table or a luminaire.
#include <filesystem>

#include "file/atomic_file.h"
#include "file/frames.h"
#include "file/tool.h"
#include "image/plot/csv_plot.h"
#include "image/show.h"
#include "image/video.h"
#include "scene/luminaire/goniometric.h"

namespace phos {
namespace {

constexpr const char* kDescription =
    "Reads OpenEXR or Radiance .hdr and writes a PNG (sRGB), or Radiance .hdr where OUTPUT ends in .hdr, or "
    "the numbers of --layer, pixel by pixel, where it ends in .csv. By default the light is tone mapped: the "
    "log-average luminance becomes a middle grey, the brightest half "
    "per cent becomes white, colours keep their hue. --false-colour shows luminance (cd/m2) or illuminance "
    "(lx) as colours, with a legend. Pixels that are not finite are magenta, and counted in a warning. From "
    "a table (comma-separated values with a line of names) it draws lines, --y over --x, as SVG or PNG. With "
    "--frames "
    "every frame of a sequence is shown with one exposure, that of the first which is not black, as pictures "
    "or, "
    "where ffmpeg is installed, as a video (.mp4, .mkv, .webm). With --goniometric it draws the luminous "
    "intensities of a luminaire, from IES LM-63 (.ies) or EULUMDAT (.ldt), as a polar plot with its lumens, "
    "maximum, and beam and field angles (within which half and a tenth of the plane's maximum are reached).";

/// Throws Error(usage) if an option was given that is for inputs of another kind.
void refuse_given(const std::string& option, const char* what_for, const std::string& input,
                  const char* what) {
  if (!option.empty())
    throw Error(ExitCode::usage, option, text("is for ", what_for, "; ", input, " is ", what));
}

/// The name says what is written, the content of the input what can be.
void check_output(const std::string& output, const std::string& input, bool image) {
  if (image && output.ends_with(".svg"))
    throw Error(ExitCode::usage, "--output",
                text(input, " is an image; the name must end in .png, .hdr or .csv"));
  if (!image && (output.ends_with(".hdr") || output.ends_with(".csv")))
    throw Error(ExitCode::usage, "--output", text(input, " is a table; the name must end in .svg or .png"));
}

template <class P>
void write_plot(const std::string& output, const P& plot, std::string (*svg)(const P&),
                Picture (*picture)(const P&, int)) {
  constexpr int kScale = 2;
  if (!output.ends_with(".svg")) return write_png(output, picture(plot, kScale));
  AtomicFile file(output);
  file.write(svg(plot));
  file.commit();
}

void draw_plot(Tool& tool, const std::string& bytes, const std::string& input,
               const CsvPlotOptions& options) {
  const CsvTable table = parse_csv(bytes, input);
  if (options.x.empty() || options.y.empty())
    throw Error(ExitCode::usage, options.x.empty() ? "--x" : "--y",
                text("name a column of ", input, ": ", table.names()));
  const Plot plot = plot_of(table, options);
  write_plot(tool.output(), plot, plot_svg, plot_picture);
  if (const std::size_t n = points_left_out(plot); n > 0) {
    tool.counters().count("point that cannot be shown", n);
    tool.warn(text(input, ": ", n, " points are left out: not finite, or not above 0 on a logarithmic axis"));
  }
}

void draw_goniometric(Tool& tool, const std::string& input) {
  const Options& options = tool.options();
  if (tool.output().ends_with(".hdr") || tool.output().ends_with(".csv"))
    throw Error(ExitCode::usage, "--output",
                "a polar plot is no image of light; the name must end in .png or .svg");
  refuse_given(given_picture_option(options), "images", input, "a luminaire");
  refuse_given(given_plot_option(options), "tables", input, "a luminaire");
  const PhotometricFile file = read_photometry(input);
  for (const std::string& warning : file.warnings) tool.warn(text(input, ": ", warning));
  const std::string name = std::filesystem::path(input).filename().string();
  if (!(file.photometry->flux_lm() > 0))
    throw Error(ExitCode::bad_input, input, "all intensities are 0: there is nothing to draw");
  write_plot(tool.output(), goniometric_plot(file, name), polar_plot_svg, polar_plot_picture);
}

void check_usage(const Options& options, const std::string& output, const PictureSequence& s,
                 bool false_colour) {
  const auto refuse = [](const char* option, const std::string& why) {
    throw Error(ExitCode::usage, option, why);
  };
  const bool video = is_video(output);
  if (!output.ends_with(".png") && !output.ends_with(".hdr") && !output.ends_with(".svg") &&
      !output.ends_with(".csv") && !video)
    refuse("--output",
           "the name must end in .png, .hdr, .csv or .svg, or for a video in .mp4, .mkv or .webm");
  if (false_colour && (output.ends_with(".hdr") || output.ends_with(".csv")))
    refuse("--false-colour", "false colours need an output that ends in .png");
  if (video && s.frames.empty()) refuse("--output", "a video is made of frames: --frames 0:47");
  if (!video && s.frames_per_s) refuse("--fps", "is of videos: -o film.mp4");
  if (s.frames.empty() && names_frames(output))
    refuse("--output", text("\"", output, "\" names a sequence; say which frames: --frames 0:47"));
  if (s.frames.empty()) return;
  if (!given_plot_option(options).empty() || output.ends_with(".svg"))
    refuse("--frames", "is for images, not for plots; leave it out");
}

int main_of_tool(int argc, const char* const* argv) {
  Tool tool("phos-picture", "makes a picture from an image of light, or a plot from a table or a luminaire",
            kDescription, 1);
  tool.output_has_no_key();
  PictureSequence sequence;
  const std::string& input = sequence.input;
  LayerPictureOptions picture;
  CsvPlotOptions plot;
  Options& options = tool.options();
  options.input(
      "INPUT", sequence.input,
      "OpenEXR, Radiance .hdr, a table (CSV), or photometry (.ies, .ldt); with --frames, a folder or a name "
      "with %04d");
  declare_options(options, picture);
  options.section("Sequences");
  declare_frames(options, sequence.frames);
  options.number("fps", sequence.frames_per_s, "N",
                 "frames a second of a video; else as the images say, else 24", kPositive);
  declare_options(options, plot);
  bool goniometric = false;
  options.section("Luminaires");
  options.flag(
      "goniometric", goniometric,
      "INPUT is a luminaire's photometry (.ies, .ldt): draw its polar plot, planes C0-C180 and C90-C270, in "
      "candela; OUTPUT ends in .png or .svg");
  options.example("phos-picture room.exr -o room.png", "as a camera would see it");
  options.example("phos-picture room.exr -o lux.png --layer illuminance --false-colour --max 1000",
                  "lux on every surface");
  options.example("phos-picture room.exr -o lux.csv --layer illuminance", "lux of every pixel, as a table");
  options.example("phos-picture film/%04d.exr --frames 0:99 -o film.mp4",
                  "a video (ffmpeg makes it), exposed as its first frame");
  options.example(
      "phos-picture errors.csv --x seconds --y rmse --series method --log-x --log-y -o errors.svg",
      "a line for each method");
  options.example("phos-picture --goniometric lamp.ies -o lamp.png", "what a luminaire does");

  return tool.run(argc, argv, [&] {
    const std::string& output = tool.output();
    if (goniometric) refuse_given(options.first_given({"frames", "fps"}), "sequences", input, "a luminaire");
    check_usage(options, output, sequence, picture.false_colour);
    if (!sequence.frames.empty()) return show_sequence(tool, sequence, picture);
    require_writable(output);
    tool.add_input("input", input);
    if (goniometric) return draw_goniometric(tool, input);
    const std::string bytes = read_text(input);
    if (looks_like_photometry(bytes))
      throw Error(ExitCode::usage, input, "is a luminaire's photometry; pass --goniometric to draw it");
    if (!is_image(bytes) && !is_named_image(input) && is_plain_text(bytes)) {
      check_output(output, input, false);
      refuse_given(given_picture_option(options), "images", input, "a table");
      return draw_plot(tool, bytes, input, plot);
    }
    const Image image = read_image(input);
    check_output(output, input, true);
    refuse_given(given_plot_option(options), "tables", input, "an image");
    if (const auto shown = show_image(tool, image, input, output, picture)) write_png(output, *shown);
  });
}

}  // namespace
}  // namespace phos

int main(int argc, char** argv) { return phos::main_of_tool(argc, argv); }
