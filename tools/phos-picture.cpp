// phos-picture: makes a picture for people from an image of light, or a plot from a table.
#include "file/atomic_file.h"
#include "file/frames.h"
#include "file/tool.h"
#include "image/csv_plot.h"
#include "image/show.h"
#include "image/video.h"

namespace phos {
namespace {

constexpr const char* kDescription =
    "Reads OpenEXR or Radiance .hdr and writes a PNG (sRGB), or Radiance .hdr where OUTPUT ends in .hdr. By "
    "default the light is tone mapped: the log-average luminance becomes a middle grey, the brightest half "
    "per cent becomes white, colours keep their hue. --false-colour shows luminance (cd/m2) or illuminance "
    "(lx) as colours, with a legend. Pixels that are not finite are magenta, and counted in a warning. From "
    "a table (comma-separated values with a line of names) it draws lines, --y over --x, as SVG or PNG. With "
    "--frames "
    "every frame of a sequence is shown with one exposure, that of the first which is not black, as pictures "
    "or, "
    "where ffmpeg is installed, as a video (.mp4, .mkv, .webm).";

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

void check_usage(const Options& options, const std::string& output, const PictureSequence& s,
                 bool false_colour) {
  const auto refuse = [](const char* option, const std::string& why) {
    throw Error(ExitCode::usage, option, why);
  };
  const bool video = is_video(output);
  if (!output.ends_with(".png") && !output.ends_with(".hdr") && !output.ends_with(".svg") && !video)
    refuse("--output", "the name must end in .png, .hdr or .svg, or for a video in .mp4, .mkv or .webm");
  if (false_colour && output.ends_with(".hdr"))
    refuse("--false-colour", "false colours need an output that ends in .png");
  if (video && s.frames.empty()) refuse("--output", "a video is made of frames: --frames 0:47");
  if (!video && s.frames_per_s) refuse("--fps", "is of videos: -o film.mp4");
  if (s.frames.empty() && names_frames(output))
    refuse("--output", text("\"", output, "\" names a sequence; say which frames: --frames 0:47"));
  if (s.frames.empty()) return;
  if (const std::string option = given_plot_option(options); !option.empty() || output.ends_with(".svg"))
    refuse("--frames", "is for images, not for plots; leave it out");
}

int main_of_tool(int argc, const char* const* argv) {
  Tool tool("phos-picture", "makes a picture from an image of light, or a plot from a table", kDescription,
            1);
  tool.output_has_no_key();
  PictureSequence sequence;
  const std::string& input = sequence.input;
  LayerPictureOptions picture;
  CsvPlotOptions plot;
  Options& options = tool.options();
  options.input("INPUT", sequence.input,
                "OpenEXR, Radiance .hdr, or a table (CSV); with --frames, a folder or a name with %04d");
  declare_options(options, picture);
  options.section("Sequences");
  declare_frames(options, sequence.frames);
  options.number("fps", sequence.frames_per_s, "N",
                 "frames a second of a video; else as the images say, else 24", kPositive);
  declare_options(options, plot);
  options.example("phos-picture room.exr -o room.png", "as a camera would see it");
  options.example("phos-picture room.exr -o lux.png --layer illuminance --false-colour --max 1000",
                  "lux on every surface");
  options.example("phos-picture film/%04d.exr --frames 0:99 -o film.mp4",
                  "a video (ffmpeg makes it), exposed as its first frame");
  options.example(
      "phos-picture errors.csv --x seconds --y rmse --series method --log-x --log-y -o errors.svg",
      "a line for each method");

  return tool.run(argc, argv, [&] {
    const std::string& output = tool.output();
    check_usage(options, output, sequence, picture.false_colour);
    if (!sequence.frames.empty()) return show_sequence(tool, sequence, picture);
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
    if (const auto shown = show_image(tool, image, input, output, picture)) write_png(output, *shown);
  });
}

}  // namespace
}  // namespace phos

int main(int argc, char** argv) { return phos::main_of_tool(argc, argv); }
