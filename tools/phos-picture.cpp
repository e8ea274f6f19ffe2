// phos-picture: makes a picture for people from an image of light, or a plot from a table, a luminaire or a
// .brdf file.
#include "stage/picture.h"

namespace {

constexpr const char* kDescription =
    "Reads OpenEXR or Radiance .hdr and writes a PNG (sRGB), or Radiance .hdr where OUTPUT ends in .hdr, or "
    "the numbers of --layer, pixel by pixel, where OUTPUT ends in .csv. By default the light is tone mapped: "
    "the log-average luminance becomes a middle grey, the brightest half per cent becomes white, colours "
    "keep their hue. --false-colour shows luminance (cd/m2) or illuminance (lx) as colours, with a legend. "
    "Pixels that are not finite are magenta, and counted in a warning. --contours draws lines of equal "
    "illuminance, or of another layer, with labels, over the picture. A table (comma-separated values with a "
    "line of names) becomes a plot in SVG or PNG: lines of --y over --x, or with --contours and --spacing "
    "lines of equal illuminance on a plane of sensors, seen from above. With --frames every frame of a "
    "sequence is shown with the exposure of the first frame that is not black, as pictures or, where ffmpeg "
    "is installed, as a video (.mp4, .mkv, .webm). With --goniometric the luminous intensities of a "
    "luminaire, from IES LM-63 (.ies) or EULUMDAT (.ldt), become a polar plot with lumens, maximum, and beam "
    "and field angles (within which half and a tenth of the plane's maximum are reached). "
    "With --discs the tables of glossy reflection of a .brdf file become discs of colours.";

}  // namespace

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-picture"), kDescription, stage::kPictureAlgorithm);
  tool.output_has_no_key();
  stage::PictureCommand asked;
  Options& options = tool.options();
  options.input("INPUT", asked.sequence.input,
                "OpenEXR, Radiance .hdr, a table (CSV), photometry (.ies, .ldt), or a .brdf file; with "
                "--frames, a folder "
                "or a name with %04d");
  declare_options(options, asked.picture);
  declare_options(options, asked.picture.contours);
  options.section("Sequences");
  declare_frames(options, asked.sequence.frames);
  options.number("fps", asked.sequence.frames_per_s, "N",
                 "frames per second of a video (default: the rate that the images state, else 24)",
                 kPositive);
  declare_options(options, asked.plot);
  options.section("Luminaires");
  options.flag("goniometric", asked.goniometric,
               "draw the polar plot of INPUT, a luminaire's photometry (.ies, .ldt): planes C0-C180 and "
               "C90-C270, in candela; OUTPUT ends in .png or .svg");
  declare_options(options, asked.discs);
  options.example("phos-picture room.exr -o room.png", "as a camera would see it");
  options.example("phos-picture room.exr -o lux.png --layer illuminance --false-colour --max 1000",
                  "lux on every surface");
  options.example("phos-picture room.exr -o lux.csv --layer illuminance", "lux of every pixel, as a table");
  options.example("phos-picture room.exr -o isolux.png --contours illuminance",
                  "the room with lines of equal lux");
  options.example("phos-picture plane.csv -o isolux.svg --contours E_lx --spacing 0.5",
                  "lines of equal lux on a workplane, from phos-sense --grid 0.5");
  options.example("phos-picture film/%04d.exr --frames 0:99 -o film.mp4",
                  "a video (ffmpeg makes it), exposed as its first frame");
  options.example(
      "phos-picture errors.csv --x seconds --y rmse --series method --log-x --log-y -o errors.svg",
      "a line for each method");
  options.example("phos-picture --goniometric lamp.ies -o lamp.png", "the polar plot of a luminaire");
  options.example("phos-picture --discs error room.brdf -o errors.png",
                  "how well harmonics hold each glossy material, from all directions of view");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
