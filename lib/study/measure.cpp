#include "study/measure.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "image/metrics.h"
#include "study/noise_free.h"

namespace phos::inline study {

namespace {

using Names = std::vector<std::string>;

std::string channel_of(const std::string& layer, const std::string& component) {
  return component.empty() ? layer : channel_name(layer, component);
}

/// The layer of standard errors of a layer.
std::string stderr_of(const std::string& layer) { return layer.empty() ? "stderr" : layer + "_stderr"; }

bool has(const Image& image, const std::string& layer, const Names& components) {
  return !components.empty() && std::all_of(components.begin(), components.end(), [&](const std::string& c) {
    return image.has(channel_of(layer, c));
  });
}

/// One layer of a reference, or the mean of two.
Image mean_of(const Image& a, const Image& b, const std::string& layer, const Names& components) {
  Image mean(a.width(), a.height());
  for (const std::string& c : components) {
    const std::span<const float> one = a.channel(channel_of(layer, c)), two = b.channel(channel_of(layer, c));
    const std::span<float> out = mean.channel(channel_of(layer, c));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(0.5 * (double{one[i]} + two[i]));
  }
  return mean;
}

/// The layer emission, not black where `mask` is 0.
void mark_lamps(Image& picture, const std::vector<char>& mask) {
  std::vector<Rgb> lamps;
  for (const char counts : mask) lamps.emplace_back(counts ? 0.f : 1.f);
  picture.set_rgb("emission", lamps);
}

void require_alike(const Image& second, const Image& reference, const std::string& layer,
                   const Names& components) {
  if (second.width() != reference.width() || second.height() != reference.height())
    throw Error(ExitCode::mismatch, "second reference",
                text("is ", second.width(), " x ", second.height(), " pixels and the first ",
                     reference.width(), " x ", reference.height(), "; make both at one size"));
  if (!has(second, layer, components))
    throw Error(
        ExitCode::mismatch, "second reference",
        text("has no layer ", layer_label(layer), " like the first's; make it with the same options"));
}

/// What is asked of one layer, at each pixel.
class Pixels {
 public:
  Pixels(const Image& image, const Image& reference, const Image* second, std::string layer, Names components)
      : image_(image),
        reference_(reference),
        second_(second),
        layer_(std::move(layer)),
        components_(std::move(components)) {}

  NoiseFrom from() const {
    if (second_) return NoiseFrom::second;
    return has(reference_, stderr_of(layer_), components_) ? NoiseFrom::stated : NoiseFrom::unknown;
  }
  bool stated() const { return has(image_, stderr_of(layer_), components_); }

  NoiseFree sums(const std::vector<char>& mask) const {
    const std::string error = stderr_of(layer_);
    const NoiseFrom noise = from();
    const bool own = stated(),
               known = has(reference_, error, components_) && (!second_ || has(*second_, error, components_));
    std::vector<std::span<const float>> result, first, second, said, spread, second_spread;
    for (const std::string& c : components_) {
      result.push_back(image_.channel(channel_of(layer_, c)));
      first.push_back(reference_.channel(channel_of(layer_, c)));
      second.push_back(second_ ? second_->channel(channel_of(layer_, c)) : first.back());
      if (own) said.push_back(image_.channel(channel_of(error, c)));
      if (!known) continue;
      spread.push_back(reference_.channel(channel_of(error, c)));
      if (second_) second_spread.push_back(second_->channel(channel_of(error, c)));
    }
    NoiseFree sums(noise, own);
    std::vector<NoiseFree::Value> place(components_.size());
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (!mask[i]) continue;
      for (std::size_t c = 0; c < place.size(); ++c) {
        const double half = 0.5 * (double{first[c][i]} - second[c][i]);
        const double s = known ? double{spread[c][i]} : half;
        const double t = known && second_ ? double{second_spread[c][i]} : s;
        const double of_mean = second_ && known ? (s * s + t * t) / 4 : s * s;
        place[c] = {result[c][i], second[c][i] + half, noise == NoiseFrom::stated ? s * s : half * half,
                    own ? double{said[c][i]} : 0, of_mean};
      }
      sums.add(place);
    }
    return sums;
  }

 private:
  const Image &image_, &reference_;
  const Image* second_;
  std::string layer_;
  Names components_;
};

}  // namespace

MeasuredError measure_picture(const Image& image, const Image& reference, const Image* second,
                              const MeasureOptions& options) {
  const std::string layer = layer_from_label(options.layer);
  common_layers(image, reference, {{options.layer}, false});  // or it throws with the fault
  const Names components = components_of(reference, layer);
  if (second) require_alike(*second, reference, layer, components);
  Image mean = mean_of(reference, second ? *second : reference, layer, components);
  const bool lamps = options.ignore_lamps && show_emission({&image, &reference, second});
  const std::vector<char> mask = emission_mask({&image, &reference, second}, lamps);
  if (lamps) mark_lamps(mean, mask);
  const LayerMetrics metrics = compare_images(image, mean, {{options.layer}, lamps}).at(0);

  MeasuredError error;
  error.quantity = metrics.layer, error.unit = metrics.unit;
  error.left_out = metrics.ignored, error.non_finite = metrics.non_finite;
  error.bias = metrics.bias, error.relative_bias = metrics.relative_bias;
  error.p99 = metrics.p99, error.max = metrics.max;
  if (metrics.visual) error.psnr_db = metrics.visual->psnr_db, error.ssim = metrics.visual->ssim;
  Pixels(image, reference, second, layer, components).sums(mask).finish(error);
  return error;
}

Json to_json(const MeasuredError& e) {
  Json j;
  j["quantity"] = e.quantity, j["unit"] = e.unit;
  j["places"] = e.places, j["left_out"] = e.left_out, j["non_finite"] = e.non_finite;
  j["magnitude"] = e.magnitude, j["rmse"] = e.rmse, j["relative_rmse"] = e.relative_rmse;
  j["bias"] = e.bias, j["relative_bias"] = e.relative_bias;
  j["p99"] = e.p99, j["relative_p99"] = e.relative_p99, j["max"] = e.max, j["resolved"] = e.resolved();
  const auto add = [&](const char* name, const std::optional<double>& v) {
    if (v) j[name] = *v;
  };
  add("psnr_db", e.psnr_db), add("ssim", e.ssim), add("reference_noise", e.noise);
  add("resolution", e.resolution), add("rmse_stderr", e.rmse_stderr), add("bias_stderr", e.bias_stderr);
  add("stated", e.stated), add("inside", e.inside);
  return j;
}

}  // namespace phos::inline study
