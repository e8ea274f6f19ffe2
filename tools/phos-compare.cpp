// phos-compare: measures how far an image is from a reference, or a sequence from another.
#include "stage/compare.h"

namespace {

constexpr const char* kDescription =
    "Both images are OpenEXR or Radiance .hdr, of one size. Differences are image - reference, over all "
    "components of all pixels of a layer. Relative measures are divided by the mean magnitude of the "
    "reference; rel.mse is mean d2 / (reference2 + e2) and rel.err is mean |d| / (|reference| + e), with d "
    "the difference and e = 1 % of the mean magnitude. PU.psnr (dB) and PU.ssim compare luminance as the eye "
    "does: in the PU21 encoding of absolute cd/m2 (Mantiuk and Azimi 2021). Above 45 dB or 0.995 a "
    "difference is hard to see. A pixel that is not finite fails the comparison. Results go to stdout; the "
    "exit code is 1 if any compared layer breaks any limit. With --flicker both inputs are sequences, and "
    "luminance is compared: flicker is the root mean square, times sqrt(2/3), of d - (the mean of d one "
    "frame before and after), so that noise of standard deviation s counts as s and an even drift as 0.";

}  // namespace

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-compare"), kDescription, stage::kCompareAlgorithm, Tool::Output::none);
  Options& o = tool.options();
  stage::CompareCommand c;
  o.input("IMAGE", c.image, "image to be judged; with --flicker, a folder or a name with %04d");
  o.input("REFERENCE", c.reference, "reference image; with --flicker, a folder or a name with %04d");
  o.section("What is compared");
  o.list("layer", c.options.layers, "LAYER",
         "layers to compare (beauty, indirect, illuminance, Z, ...) (default: all common layers)");
  o.file("second-reference", c.second,
         "the same reference made with another seed: gives the rmse without the noise of the two references");
  o.flag("ignore-emission", c.options.ignore_emission,
         "leave out pixels that show emission (layer emission not black) in any of the images");
  o.flag("flicker", c.flicker, "compare sequences: error over all frames, and flicker");
  declare_frames(o, c.frames);
  o.section("Results");
  o.flag("json", c.json, "print JSON instead of a table");
  o.file("difference", c.difference,
         "write the signed difference: .png (first layer, blue below, red above, with a legend) or .exr (all "
         "layers); with --flicker, the flicker of each pixel",
         FileUse::written);
  o.number("difference-range", c.range, "X",
           "difference that full blue and full red stand for; 0: the 99th percentile (for flicker: the top "
           "of the scale)",
           kNotNegative);
  o.file("per-frame", c.per_frame, "with --flicker: write error and flicker of each frame to this CSV",
         FileUse::written);
  o.section("Limits: exit code 1 beyond");
  c.limits.declare(o);
  o.example("phos-compare room.exr reference.exr --layer indirect --max-bias 0.01",
            "is indirect light within 1 % on average?");
  o.example("phos-compare a.exr b.exr --difference d.png", "where do they differ?");
  o.example(
      "phos-compare film/%04d.exr truth/%04d.exr --frames 0:99 --flicker --layer beauty --max-flicker 0.005",
      "does an animation flicker?");

  return tool.run(argc, argv, [&] { stage::run(tool, c); });
}
