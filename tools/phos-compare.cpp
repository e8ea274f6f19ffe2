// phos-compare: measures how far an image is from a reference.
#include <cmath>
#include <cstdio>

#include "file/tool.h"
#include "image/false_colour.h"
#include "image/metrics.h"

namespace phos {
namespace {

constexpr const char* kDescription =
    "Both images are OpenEXR or Radiance .hdr, of one size. Differences are image - reference, over all "
    "components of "
    "all pixels of a layer. relative measures are divided by the mean magnitude of the reference; rel.mse is "
    "mean d2 / "
    "(reference2 + e2) and rel.err is mean |d| / (|reference| + e), with e = 1 % of that magnitude. PU.psnr "
    "(dB) and "
    "PU.ssim compare luminance as the eye does: in the PU21 encoding of absolute cd/m2 (Mantiuk and Azimi "
    "2021). Above "
    "45 dB or 0.995 a difference is hard to see. A pixel that is not finite fails the comparison. Results go "
    "to stdout; "
    "the exit code is 1 if any compared layer breaks any limit.";

struct Limit {
  const char* option;
  const char* unit;
  const char* help;
  double (*measure)(const LayerMetrics&);
  bool at_least = false;
  std::optional<double> value{};
};

Limit limits[] = {
    {"max-rmse", "X", "root mean square difference, in the layer's unit",
     [](const LayerMetrics& m) { return m.rmse; }},
    {"max-relative-rmse", "X", "rmse / mean magnitude of the reference",
     [](const LayerMetrics& m) { return m.relative_rmse; }},
    {"max-relative-mse", "X", "mean of squared relative differences",
     [](const LayerMetrics& m) { return m.relative_mse; }},
    {"max-relative-error", "X", "mean relative error",
     [](const LayerMetrics& m) { return m.mean_relative_error; }},
    {"max-bias", "X", "size of the mean difference / mean magnitude of the reference",
     [](const LayerMetrics& m) { return std::fabs(m.relative_bias); }},
    {"max-absolute-bias", "X", "size of the mean difference, in the layer's unit",
     [](const LayerMetrics& m) { return std::fabs(m.bias); }},
    {"max-p99", "X", "99th percentile of differences, in the layer's unit",
     [](const LayerMetrics& m) { return m.p99; }},
    {"max-difference", "X", "largest difference, in the layer's unit",
     [](const LayerMetrics& m) { return m.max; }},
    {"min-pu-psnr", "DB", "PU21 PSNR of layers in cd/m2",
     [](const LayerMetrics& m) { return m.visual ? m.visual->psnr_db : INFINITY; }, true},
    {"min-pu-ssim", "X", "PU21 SSIM of layers in cd/m2",
     [](const LayerMetrics& m) { return m.visual ? m.visual->ssim : 1.0; }, true},
};

/// What is wrong, in one line; "" if nothing is.
std::string verdict(const std::vector<LayerMetrics>& all) {
  std::string s;
  const auto add = [&s](const std::string& what) { s += (s.empty() ? "" : "; ") + what; };
  for (const LayerMetrics& m : all) {
    if (m.non_finite > 0) add(text(m.layer, ": ", m.non_finite, " pixels are not finite"));
    for (const Limit& limit : limits) {
      if (!limit.value) continue;
      const double v = limit.measure(m);
      if (limit.at_least ? v >= *limit.value : v <= *limit.value) continue;
      add(text(m.layer, ": ", std::string(limit.option).substr(4), " ", shortest(static_cast<float>(v)),
               " is ", limit.at_least ? "below " : "above ", shortest(*limit.value)));
    }
  }
  return s;
}

void write_difference(const std::string& path, const Image& image, const Image& reference,
                      CompareOptions options, double range) {
  if (path.ends_with(".exr")) return write_exr(path, difference_image(image, reference, options));
  if (!path.ends_with(".png"))
    throw Error(ExitCode::usage, "--difference", "the name must end in .png or .exr");
  if (options.layers.empty())
    options.layers = {image.has_layer("") ? "beauty" : layer_label(all_layers(image)[0])};
  const std::string& label = options.layers[0];
  const std::vector<float> values =
      layer_values(difference_image(image, reference, options), layer_from_label(label));
  write_png(path, difference_picture(values, image.width(), image.height(), range, label + " - reference",
                                     layer_unit(layer_from_label(label))));
}

int main_of_tool(int argc, const char* const* argv) {
  Tool tool("phos-compare", "measures how far an image is from a reference", kDescription, 1,
            Tool::Output::none);
  Options& o = tool.options();
  std::string image_path, reference_path, second_path, difference_path;
  CompareOptions options;
  bool json = false;
  double range = 0;
  o.input("IMAGE", image_path, "the image to be judged");
  o.input("REFERENCE", reference_path, "the image that is taken for right");
  o.section("What is compared");
  o.list("layer", options.layers, "LAYER",
         "layers to compare (beauty, indirect, illuminance, Z, ...); else all common ones");
  o.file("second-reference", second_path,
         "the reference made with another seed: gives the rmse without the noise of the two");
  o.flag("ignore-emission", options.ignore_emission, "leave out pixels whose layer emission is not black");
  o.section("Results");
  o.flag("json", json, "print JSON instead of a table");
  o.file("difference", difference_path,
         "write the signed difference: .png (first layer, blue below, red above, with a legend) or .exr (all "
         "layers)");
  o.number("difference-range", range, "X", "what full blue and full red stand for; 0: the 99th percentile",
           kNotNegative);
  o.section("Limits: exit code 1 beyond");
  for (Limit& limit : limits) o.number(limit.option, limit.value, limit.unit, limit.help, kNotNegative);
  o.example("phos-compare room.exr reference.exr --layer indirect --max-bias 0.01",
            "is indirect light within 1 % on average?");
  o.example("phos-compare a.exr b.exr --difference d.png", "where do they differ?");

  return tool.run(argc, argv, [&] {
    tool.add_input("image", image_path);
    tool.add_input("reference", reference_path);
    if (!second_path.empty()) tool.add_input("second reference", second_path);
    const Image image = read_image(image_path), reference = read_image(reference_path);
    std::optional<Image> second;
    if (!second_path.empty()) second = read_image(second_path);
    const std::vector<LayerMetrics> all =
        compare_images(image, reference, options, second ? &*second : nullptr);
    if (!difference_path.empty()) write_difference(difference_path, image, reference, options, range);
    const std::string failure = verdict(all);
    if (json) {
      Json::Array layers;
      for (const LayerMetrics& m : all) layers.push_back(to_json(m));
      Json result;
      result["layers"] = std::move(layers), result["passed"] = failure.empty();
      std::puts(result.dump(2).c_str());
    } else {
      std::fputs(to_table(all).c_str(), stdout);
    }
    if (failure.empty()) return;
    tool.warn(failure);
    tool.set_exit(ExitCode::check_failed);
  });
}

}  // namespace
}  // namespace phos

int main(int argc, char** argv) { return phos::main_of_tool(argc, argv); }
