#include "stage/picture.h"

#include <filesystem>

#include "file/atomic_file.h"
#include "file/container.h"
#include "file/frames.h"
#include "image/events.h"
#include "image/video.h"
#include "radiance/brdf/file.h"
#include "scene/luminaire/goniometric.h"

namespace phos::stage {
namespace {

/// Throws Error(usage) if an option was given that is for inputs of another kind.
void refuse_given(const std::string& option, const char* what_for, const std::string& input,
                  const char* what) {
  if (!option.empty())
    throw Error(ExitCode::usage, option, text("is for ", what_for, "; ", input, " is ", what));
}

/// The name chooses the kind of output, among the kinds that the content of the input allows.
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

/// Places of rows that a later row hides are counted.
void draw_plan(Tool& tool, const std::string& bytes, const std::string& input, const PictureCommand& asked) {
  const Options& options = tool.options();
  refuse_given(options.first_given({"x", "y", "series", "where", "log-x", "log-y", "x-min", "x-max", "y-min",
                                    "y-max", "x-label", "y-label", "plot-height"}),
               "lines over --x", input, "drawn as a plan, by --contours");
  check_usage(asked.picture.contours, true);
  TableContours drawn = contours_of(parse_csv(bytes, input), asked.picture.contours);
  drawn.plan.title = asked.plot.title, drawn.plan.width = static_cast<int>(asked.plot.width);
  if (drawn.hidden > 0)
    tool.warn(text(input, ": ", drawn.hidden,
                   " rows are hidden by later ones at the same x and z; give a table of one plane"));
  write_plot(tool.output(), drawn.plan, contour_plan_svg, contour_plan_picture);
}

void draw_plot(Tool& tool, const std::string& bytes, const std::string& input,
               const CsvPlotOptions& options) {
  const CsvTable table = parse_csv(bytes, input);
  if (options.x.empty() || options.y.empty())
    throw Error(ExitCode::usage, options.x.empty() ? "--x" : "--y",
                text("is missing; give a column of ", input, ": ", table.names()));
  const Plot plot = plot_of(table, options);
  write_plot(tool.output(), plot, plot_svg, plot_picture);
  if (const std::size_t n = points_left_out(plot); n > 0) {
    tool.counters().count(kNotShownEvent, n);
    tool.warn(text(input, ": ", n, " points are left out: not finite, or not above 0 on a logarithmic axis"));
  }
}

void draw_goniometric(Tool& tool, const std::string& input) {
  const Options& options = tool.options();
  if (tool.output().ends_with(".hdr") || tool.output().ends_with(".csv"))
    throw Error(ExitCode::usage, "--output", "a polar plot needs a name that ends in .png or .svg");
  refuse_given(given_picture_option(options), "images", input, "a luminaire");
  refuse_given(given_plot_option(options), "tables", input, "a luminaire");
  refuse_given(given_contour_option(options), "images and tables", input, "a luminaire");
  const PhotometricFile file = read_photometry(input);
  for (const std::string& warning : file.warnings) tool.warn(text(input, ": ", warning));
  const std::string name = std::filesystem::path(input).filename().string();
  if (!(file.photometry->flux_lm() > 0))
    throw Error(ExitCode::bad_input, input, "all intensities are 0: there is nothing to draw");
  write_plot(tool.output(), goniometric_plot(file, name), polar_plot_svg, polar_plot_picture);
}

void draw_discs(Tool& tool, const std::string& input, BrdfDiscs which) {
  const Options& options = tool.options();
  constexpr const char* kWhat = "drawn as discs";
  if (!tool.output().ends_with(".png"))
    throw Error(ExitCode::usage, "--output", "discs are drawn as pixels; the name must end in .png");
  refuse_given(given_picture_option(options), "images", input, kWhat);
  refuse_given(given_plot_option(options), "tables", input, kWhat);
  refuse_given(given_contour_option(options), "images and tables", input, kWhat);
  const Container file = Container::open(input);
  if (file.kind() != FileKind::brdf)
    throw Error(
        ExitCode::bad_input, input,
        text("holds ", name_of(file.kind()), ", and --discs draws a .brdf file; phos-brdf makes one"));
  const std::vector<BrdfTable> tables = read_brdf(file);
  try {
    write_png(tool.output(), disc_plot_picture(discs_of(tables, which)));
  } catch (const Error& e) {
    throw e.where().empty() ? Error(e.code(), input, e.what()) : e;
  }
}

void check_usage(const Options& options, const std::string& output, const PictureSequence& s,
                 const LayerPictureOptions& picture) {
  const auto refuse = [](const char* option, const std::string& why) {
    throw Error(ExitCode::usage, option, why);
  };
  const bool video = is_video(output);
  if (!output.ends_with(".png") && !output.ends_with(".hdr") && !output.ends_with(".svg") &&
      !output.ends_with(".csv") && !video)
    refuse("--output",
           "the name must end in .png, .hdr, .csv or .svg, or for a video in .mp4, .mkv or .webm");
  if (picture.false_colour && (output.ends_with(".hdr") || output.ends_with(".csv")))
    refuse("--false-colour", "false colours need an output that ends in .png");
  if (!picture.contours.of.empty() && (output.ends_with(".hdr") || output.ends_with(".csv")))
    refuse("--contours", "lines of equal value need an output that ends in .png or .svg");
  if (video && s.frames.empty()) refuse("--output", "a video needs frames; give --frames 0:47");
  if (!video && s.frames_per_s) refuse("--fps", "needs a video; give -o film.mp4, or leave it out");
  if (s.frames.empty() && names_frames(output))
    refuse("--output", text("\"", output, "\" names a sequence; say which frames: --frames 0:47"));
  if (s.frames.empty()) return;
  if (!given_plot_option(options).empty() || output.ends_with(".svg"))
    refuse("--frames", "is for images, not for plots; leave it out");
}

}  // namespace

void run(Tool& tool, const PictureCommand& asked) {
  const PictureSequence& sequence = asked.sequence;
  const LayerPictureOptions& picture = asked.picture;
  const std::string& input = sequence.input;
  const std::string& output = tool.output();
  const bool discs = asked.discs != BrdfDiscs::none;
  if (discs && asked.goniometric)
    throw Error(ExitCode::usage, "--goniometric", "draws a luminaire, --discs a .brdf file; leave one out");
  if (asked.goniometric || discs)
    refuse_given(tool.options().first_given({"frames", "fps"}), "sequences", input,
                 discs ? "drawn as discs" : "a luminaire");
  check_usage(tool.options(), output, sequence, picture);
  if (!sequence.frames.empty()) check_usage(picture.contours, false);
  if (!sequence.frames.empty()) return show_sequence(tool, sequence, picture);
  require_writable(output);
  tool.add_input("input", input);
  if (asked.goniometric) return draw_goniometric(tool, input);
  if (discs) return draw_discs(tool, input, asked.discs);
  if (is_container(input) && Container::open(input).kind() == FileKind::brdf)
    throw Error(ExitCode::usage, input, "holds tables of glossy reflection; pass --discs error to draw them");
  const std::string bytes = read_text(input);
  if (looks_like_photometry(bytes))
    throw Error(ExitCode::usage, input, "is a luminaire's photometry; pass --goniometric to draw it");
  if (!is_image(bytes) && !is_named_image(input) && is_plain_text(bytes)) {
    check_output(output, input, false);
    refuse_given(given_picture_option(tool.options()), "images", input, "a table");
    if (!picture.contours.of.empty()) return draw_plan(tool, bytes, input, asked);
    check_usage(picture.contours, true);
    return draw_plot(tool, bytes, input, asked.plot);
  }
  const Image image = read_image(input);
  check_output(output, input, true);
  refuse_given(given_plot_option(tool.options()), "tables", input, "an image");
  check_usage(picture.contours, false);
  if (const auto shown = show_image(tool, image, input, output, picture)) write_png(output, *shown);
}

}  // namespace phos::stage
