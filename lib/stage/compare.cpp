#include "stage/compare.h"

#include <cstdio>

#include "file/atomic_file.h"
#include "file/frames.h"
#include "image/false_colour.h"

namespace phos::stage {
namespace {

void write_difference(const CompareCommand& c, const Image& image, const Image& reference) {
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
std::string compare_pair(Tool& tool, const CompareCommand& c) {
  tool.add_input("image", c.image);
  tool.add_input("reference", c.reference);
  if (!c.second.empty()) tool.add_input("second reference", c.second);
  const Image image = read_image(c.image), reference = read_image(c.reference);
  std::optional<Image> second;
  if (!c.second.empty()) second = read_image(c.second);
  const std::vector<LayerMetrics> all =
      compare_images(image, reference, c.options, second ? &*second : nullptr);
  if (!c.difference.empty()) write_difference(c, image, reference);
  std::string failure = c.limits.verdict(all);
  print(all, c.json, failure.empty());
  return failure;
}

std::string compare_sequences(const CompareCommand& c) {
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
  std::string failure = c.limits.verdict(all);
  print(all, c.json, failure.empty());
  return failure;
}

void check_usage(const CompareCommand& c) {
  c.limits.require_measured(c.flicker);
  if (c.flicker && c.frames.empty())
    throw Error(ExitCode::usage, "--flicker", "compares sequences; say which frames: --frames 0:47");
  if (!c.flicker && !c.frames.empty())
    throw Error(ExitCode::usage, "--frames", "is for sequences; give --flicker too");
  if (!c.flicker && !c.per_frame.empty())
    throw Error(ExitCode::usage, "--per-frame", "is for sequences; give --flicker too");
  if (!c.difference.empty() && !c.difference.ends_with(".exr") && !c.difference.ends_with(".png"))
    throw Error(ExitCode::usage, "--difference", "the name must end in .png or .exr");
}

}  // namespace

void run(Tool& tool, const CompareCommand& asked) {
  check_usage(asked);
  const std::string failure = asked.flicker ? compare_sequences(asked) : compare_pair(tool, asked);
  if (failure.empty()) return;
  tool.warn(failure);
  tool.set_exit(ExitCode::check_failed);
}

}  // namespace phos::stage
