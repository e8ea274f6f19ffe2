#include "splat/picture/layers.h"

#include <algorithm>
#include <array>
#include <functional>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text/append_item.h"

namespace phos::inline splat {
namespace {

constexpr std::array<const char*, 13> kNames{"beauty",   "direct",   "indirect", "glossy",      "specular",
                                             "emission", "stderr",   "albedo",   "illuminance", "weight",
                                             "normal",   "position", "Z"};

constexpr std::size_t kChunk = 1 << 14;

template <class T>
void add_to(std::vector<T>& sums, std::size_t i, const T& value) {
  if (!sums.empty()) sums[i] += value;
}

Rgb times_of(int times, const Rgb& value) { return static_cast<float>(times) * value; }
DVec3 times_of(int times, const DVec3& value) { return static_cast<double>(times) * value; }
float times_of(int times, float value) { return static_cast<float>(times) * value; }

bool black(std::span<const Rgb> values) {
  return std::all_of(values.begin(), values.end(), [](const Rgb& v) { return v == Rgb(0); });
}

}  // namespace

LayerSet::LayerSet(std::span<const std::string> layers) {
  for (const std::string& name : layers) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (name == "all")
      all_ = true, bits_ = (1u << kNames.size()) - 1;
    else if (found != kNames.end())
      bits_ |= 1u << (found - kNames.begin());
    else
      throw Error(ExitCode::usage, "--layers",
                  text("there is no layer \"", name, "\"; give all, or some of ", names()));
  }
  if (bits_ == 0) throw Error(ExitCode::usage, "--layers", "names no layer; give all, or some of " + names());
}

bool LayerSet::show_light() const {
  constexpr std::array kNoLight{Layer::albedo, Layer::weight, Layer::normal, Layer::position, Layer::depth};
  unsigned light = bits_;
  for (const Layer layer : kNoLight) light &= ~(1u << static_cast<unsigned>(layer));
  return light != 0;
}

std::string LayerSet::names() {
  std::string all;
  for (const char* name : kNames) append_item(all, name);
  return all;
}

Layers::Layers(int width, int height, const LayerSet& wanted, int most_samples, int spread_from)
    : width_(width), height_(height), spread_from_(std::max(spread_from, 2)), wanted_(wanted) {
  const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<std::function<void()>> makes;  // clearing so much memory takes a while: at once
  const auto make = [&](Layer layer, auto&... sums) {
    if (wanted.has(layer)) (makes.emplace_back([&sums, n] { sums.resize(n); }), ...);
  };
  make(Layer::beauty, beauty_);
  make(wanted.has(Layer::direct) ? Layer::direct : Layer::beauty, direct_);  // see image()
  make(Layer::indirect, indirect_);
  make(Layer::glossy, glossy_);
  make(Layer::specular, specular_);
  make(Layer::emission, emission_);
  make(Layer::stderr_, variance_, indirect_error_);
  if (most_samples >= spread_from_) make(Layer::stderr_, noisy_, noisy_square_);
  make(Layer::albedo, albedo_);
  make(Layer::illuminance, illuminance_);
  make(Layer::weight, weight_);
  make(Layer::normal, normal_);
  make(Layer::position, position_);
  make(Layer::depth, depth_);
  parallel_for(makes.size(), 1, [&](std::size_t k) { makes[k](); });
}

double Layers::bytes_of_pixel(const LayerSet& wanted) {
  const auto of = [&](Layer layer, std::size_t sums) {
    return wanted.has(layer) ? static_cast<double>(sums + sizeof(Rgb)) : 0.0;
  };
  double bytes = sizeof(Rgb) + sizeof(std::uint16_t);  // direct_, and how many samples
  for (const Layer layer : {Layer::beauty, Layer::indirect, Layer::glossy, Layer::specular, Layer::emission,
                            Layer::albedo, Layer::normal, Layer::position})
    bytes += of(layer, sizeof(Rgb));
  bytes += of(Layer::stderr_, 3 * sizeof(DVec3) + sizeof(Rgb));
  for (const Layer layer : {Layer::illuminance, Layer::weight, Layer::depth})
    bytes += of(layer, sizeof(float)) - (wanted.has(layer) ? sizeof(Rgb) - sizeof(float) : 0);
  return bytes;
}

void Layers::add(std::size_t i, const PixelSample& s, int times) {
  const auto add = [&](auto& sums, const auto& value) { add_to(sums, i, times_of(times, value)); };
  add(beauty_, s.beauty());
  add(direct_, s.direct);
  add(indirect_, s.indirect);
  add(glossy_, s.glossy);
  add(specular_, s.specular);
  add(emission_, s.emission);
  add(albedo_, s.albedo);
  add(variance_, s.variance);
  add(noisy_, DVec3(s.noisy));
  add(noisy_square_, DVec3(s.noisy) * DVec3(s.noisy));
  add(indirect_error_, s.indirect_error);
  add(illuminance_, s.illuminance_lx);
  add(weight_, s.weight);
}

void Layers::set_surface(std::size_t i, const Vec3& position, const Vec3& normal, float depth_m) {
  add_to(position_, i, position);
  add_to(normal_, i, normal);
  add_to(depth_, i, depth_m);
}

Rgb Layers::standard_error(std::size_t i, int samples) const {
  const auto n = static_cast<double>(samples);
  DVec3 variance = variance_[i] / (n * n);
  if (samples >= spread_from_) {
    // The spread has the noise of each sample's rays, but not of rays that samples share.
    const DVec3 mean = noisy_[i] / n;
    variance = glm::max(variance, glm::max(noisy_square_[i] / n - mean * mean, DVec3(0)) / (n - 1));
  }
  const DVec3 shared = DVec3(indirect_error_[i]) / n;
  return Rgb(glm::sqrt(variance + shared * shared));
}

Image Layers::image(std::span<const std::uint16_t> samples) const {
  Image image(width_, height_);
  const std::size_t pixels = samples.size();
  std::vector<Rgb> values(pixels);
  const auto put = [&](const char* name, const auto& value) {
    parallel_for(pixels, kChunk, [&](std::size_t i) { values[i] = value(i); });
    image.set_rgb(name, values);
  };
  const auto put_mean = [&](const char* name, const std::vector<Rgb>& sums, bool even_if_black) {
    if (sums.empty() || (!even_if_black && black(sums))) return;
    put(name, [&](std::size_t i) { return sums[i] / static_cast<float>(samples[i]); });
  };
  // Estimates of a lamp in half shadow that are right in the mean may come out below no light.
  const auto lacks = [&](std::size_t i) { return glm::min(direct_[i], Rgb(0)); };
  const auto put_lit = [&](const char* name, const std::vector<Rgb>& sums) {
    put(name, [&](std::size_t i) { return (sums[i] - lacks(i)) / static_cast<float>(samples[i]); });
  };
  if (!beauty_.empty()) put_lit("", beauty_);
  if (wanted_.has(Layer::direct)) put_lit("direct", direct_);
  put_mean("indirect", indirect_, true);
  put_mean("emission", emission_, true);
  put_mean("albedo", albedo_, true);
  put_mean("glossy", glossy_, !wanted_.all());
  put_mean("specular", specular_, !wanted_.all());
  if (!variance_.empty()) put("stderr", [&](std::size_t i) { return standard_error(i, samples[i]); });
  const auto put_channel = [&](const std::string& name, bool wanted, const auto& value) {
    if (!wanted) return;
    const std::span<float> channel = image.channel(name);
    parallel_for(pixels, kChunk, [&](std::size_t i) { channel[i] = value(i); });
  };
  put_channel("illuminance.Y", !illuminance_.empty(),
              [&](std::size_t i) { return std::max(illuminance_[i], 0.f) / static_cast<float>(samples[i]); });
  put_channel("weight.Y", !weight_.empty(),
              [&](std::size_t i) { return weight_[i] / static_cast<float>(samples[i]); });
  put_channel("Z", !depth_.empty(), [&](std::size_t i) { return depth_[i]; });
  for (int c = 0; c < 3; ++c) {
    const std::string axis(1, "XYZ"[c]);
    put_channel("normal." + axis, !normal_.empty(), [&](std::size_t i) { return normal_[i][c]; });
    put_channel("position." + axis, !position_.empty(), [&](std::size_t i) { return position_[i][c]; });
  }
  return image;
}

}  // namespace phos::inline splat
