// phos-compare: measures how far an image is from a reference, or a sequence from another.
#include <cstdio>

#include "file/atomic_file.h"
#include "file/frames.h"
#include "file/tool.h"
#include "image/compare_limits.h"
#include "image/false_colour.h"

namespace phos {
namespace {

constexpr const char* kDescription =
    "Both images are OpenEXR or Radiance .hdr, of one size. Differences are image - reference, over all "
    "components of all pixels of a layer. relative measures are divided by the mean magnitude of the "
    "reference; rel.mse is mean d2 / (reference2 + e2) and rel.err is mean |d| / (|reference| + e), with e = "
    "1 "
    "% of that magnitude. PU.psnr (dB) and PU.ssim compare luminance as the eye does: in the PU21 encoding "
    "of "
    "absolute cd/m2 (Mantiuk and Azimi 2021). Above 45 dB or 0.995 a difference is hard to see. A pixel that "
    "is not finite fails the comparison. Results go to stdout; the exit code is 1 if any compared layer "
    "breaks "
    "any limit. With --flicker both are sequences, and luminance is compared: flicker is what changes from "
    "frame to frame in the difference, the root mean square of d - (the mean of d one frame before and "
    "after), "
    "times sqrt(2/3), so that noise of standard deviation s counts as s and an even drift as 0.";

struct Compared {
  std::string image, reference, second, frames, difference, per_frame;
  CompareOptions options;
  bool json = false, flicker = false;
  double range = 0;
};

void write_difference(const Compared& c, const Image& image, const Image& reference) {
  CompareOptions options = c.options;
  if (c.difference.ends_with(".exr"))
    return write_exr(c.difference, difference_image(image, reference, options));
  if (options.layers.empty())
    options.layers = {image.has_layer("") ? "beauty" : layer_label(all_layers(image)[0])};
  const std::string& label = options.layers[0];
  const std::vector<float> values =
      layer_values(difference_image(image, reference, options), layer_from_label(label));
  write_png(c.difference, difference_picture(values, image.width(), image.height(), c.range,
                                             label + " - reference", layer_unit(layer_from_label(label))));
}

template <class Metrics>
void print(const std::vector<Metrics>& all, bool json, bool passed) {
  if (!json) {
    std::fputs(to_table(all).c_str(), stdout);
    return;
  }
  Json::Array layers;
  for (const Metrics& m : all) layers.push_back(to_json(m));
  Json result;
  result["layers"] = std::move(layers), result["passed"] = passed;
  std::puts(result.dump(2).c_str());
}

/// Says what is wrong; "" if nothing is.
std::string compare_pair(Tool& tool, const Compared& c, const CompareLimits& limits) {
  tool.add_input("image", c.image);
  tool.add_input("reference", c.reference);
  if (!c.second.empty()) tool.add_input("second reference", c.second);
  const Image image = read_image(c.image), reference = read_image(c.reference);
  std::optional<Image> second;
  if (!c.second.empty()) second = read_image(c.second);
  const std::vector<LayerMetrics> all =
      compare_images(image, reference, c.options, second ? &*second : nullptr);
  if (!c.difference.empty()) write_difference(c, image, reference);
  std::string failure = limits.verdict(all);
  print(all, c.json, failure.empty());
  return failure;
}

std::string compare_sequences(const Compared& c, const CompareLimits& limits) {
  const FrameRange range = parse_frames(c.frames);
  if (range.count() < 3)
    throw Error(ExitCode::usage, "--frames", "flicker needs three frames or more; give a longer range");
  const FramePattern images = existing_sequence(c.image, range, "IMAGE"),
                     references = existing_sequence(c.reference, range, "REFERENCE");
  std::optional<FramePattern> seconds;
  if (!c.second.empty()) seconds = existing_sequence(c.second, range, "--second-reference");
  const FlickerMeter meter =
      measure_flicker(images, references, seconds ? &*seconds : nullptr, range, c.options);
  const std::vector<FlickerMetrics> all = meter.metrics();
  if (c.difference.ends_with(".exr")) write_exr(c.difference, meter.picture());
  if (c.difference.ends_with(".png"))
    write_png(c.difference, flicker_picture(meter, 0, c.range > 0 ? std::optional(c.range) : std::nullopt));
  if (!c.per_frame.empty()) {
    AtomicFile file(c.per_frame);
    file.write(to_csv(meter.frames()));
    file.commit();
  }
  std::string failure = limits.verdict(all);
  print(all, c.json, failure.empty());
  return failure;
}

void check_usage(const Compared& c, const CompareLimits& limits) {
  limits.require_measured(c.flicker);
  if (c.flicker && c.frames.empty())
    throw Error(ExitCode::usage, "--flicker", "compares sequences; say which frames: --frames 0:47");
  if (!c.flicker && !c.frames.empty())
    throw Error(ExitCode::usage, "--frames", "is for sequences; give --flicker too");
  if (!c.flicker && !c.per_frame.empty())
    throw Error(ExitCode::usage, "--per-frame", "is for sequences; give --flicker too");
  if (!c.difference.empty() && !c.difference.ends_with(".exr") && !c.difference.ends_with(".png"))
    throw Error(ExitCode::usage, "--difference", "the name must end in .png or .exr");
}

int main_of_tool(int argc, const char* const* argv) {
  Tool tool("phos-compare", "measures how far an image is from a reference", kDescription, 1,
            Tool::Output::none);
  Options& o = tool.options();
  Compared c;
  CompareLimits limits;
  o.input("IMAGE", c.image, "the image to be judged; with --flicker, a folder or a name with %04d");
  o.input("REFERENCE", c.reference, "the image that is taken for right, or the sequence");
  o.section("What is compared");
  o.list("layer", c.options.layers, "LAYER",
         "layers to compare (beauty, indirect, illuminance, Z, ...); else all common ones");
  o.file("second-reference", c.second,
         "the reference made with another seed: gives the rmse without the noise of the two");
  o.flag("ignore-emission", c.options.ignore_emission,
         "leave out pixels whose layer emission is not black in any of the images");
  o.flag("flicker", c.flicker, "compare sequences: error over all frames, and flicker");
  declare_frames(o, c.frames);
  o.section("Results");
  o.flag("json", c.json, "print JSON instead of a table");
  o.file("difference", c.difference,
         "write the signed difference: .png (first layer, blue below, red above, with a legend) or .exr (all "
         "layers); with --flicker, the flicker of each pixel",
         FileUse::written);
  o.number("difference-range", c.range, "X",
           "what full blue and full red stand for; 0: the 99th percentile (of flicker: the top of the scale)",
           kNotNegative);
  o.file("per-frame", c.per_frame, "with --flicker, write error and flicker of each frame there (CSV)",
         FileUse::written);
  o.section("Limits: exit code 1 beyond");
  limits.declare(o);
  o.example("phos-compare room.exr reference.exr --layer indirect --max-bias 0.01",
            "is indirect light within 1 % on average?");
  o.example("phos-compare a.exr b.exr --difference d.png", "where do they differ?");
  o.example(
      "phos-compare film/%04d.exr truth/%04d.exr --frames 0:99 --flicker --layer beauty --max-flicker 0.005",
      "does an animation flicker?");

  return tool.run(argc, argv, [&] {
    check_usage(c, limits);
    const std::string failure = c.flicker ? compare_sequences(c, limits) : compare_pair(tool, c, limits);
    if (failure.empty()) return;
    tool.warn(failure);
    tool.set_exit(ExitCode::check_failed);
  });
}

}  // namespace
}  // namespace phos

int main(int argc, char** argv) { return phos::main_of_tool(argc, argv); }
