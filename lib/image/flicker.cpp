#include "image/flicker.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "image/false_colour.h"

namespace phos::inline image {
namespace {

constexpr float kLeftOut = std::numeric_limits<float>::quiet_NaN();
constexpr double kWhite = 2.0 / 3.0;  ///< mean h^2 of white noise is 3/2 of its variance

double ratio(double part, double whole) {
  if (part == 0) return 0;
  return whole > 0 ? part / whole : std::copysign(std::numeric_limits<double>::infinity(), part);
}

double mean(double sum, std::size_t n) { return n == 0 ? 0.0 : sum / static_cast<double>(n); }
double root(double square) { return std::sqrt(std::max(0.0, square)); }

bool is_scalar(const std::vector<std::string>& components) {
  return components.size() == 1 || components == std::vector<std::string>{"R", "G", "B"};
}

/// h of a pixel whose differences these are; NaN if any is left out.
float high_frequency(const std::vector<float> (&d)[3], std::size_t i) {
  return d[1][i] - 0.5f * (d[0][i] + d[2][i]);
}

}  // namespace

void FlickerMeter::choose_layers(const Image& image, const Image& reference, const Image* second) {
  width_ = reference.width(), height_ = reference.height(), two_references_ = second != nullptr;
  for (const std::string& name : common_layers(image, reference, options_)) {
    const std::vector<std::string> components = components_of(reference, name);
    if (!is_scalar(components) && options_.layers.empty()) continue;
    layer_values(reference, name);  // refuses layers that are no single quantity
    layers_.push_back({});
    Layer& layer = layers_.back();
    layer.name = name, layer.components = components;
    layer.hh.resize(reference.pixels()), layer.n.resize(reference.pixels());
    if (second) layer.hh_second.resize(reference.pixels()), layer.n_second.resize(reference.pixels());
  }
  if (layers_.empty())
    throw Error(ExitCode::mismatch, "",
                "no layer is a single quantity or a colour; compare images with such a layer");
}

void FlickerMeter::require_layers(const Image& image, const char* which) const {
  if (image.width() != width_ || image.height() != height_)
    throw Error(ExitCode::mismatch, "",
                text("the ", which, " is ", image.width(), " x ", image.height(), " pixels, others are ",
                     width_, " x ", height_, "; render all frames at one size"));
  for (const Layer& layer : layers_)
    if (components_of(image, layer.name) != layer.components)
      throw Error(ExitCode::mismatch, "",
                  text("the ", which, " has no layer \"", layer_label(layer.name),
                       "\" as the first reference has; render all frames with the same layers"));
}

void FlickerMeter::add(std::int64_t frame, const Image& image, const Image& reference, const Image* second) {
  if (layers_.empty()) choose_layers(image, reference, second);
  PHOS_CHECK(two_references_ == (second != nullptr), "second reference at some frames only, frame ", frame);
  require_layers(image, "image");
  require_layers(reference, "reference");
  if (second) require_layers(*second, "second reference");
  const std::vector<char> counts = emission_mask({&image, &reference, second}, options_.ignore_emission);
  ++added_;
  for (Layer& layer : layers_) take(layer, frame, image, reference, second, counts);
}

void FlickerMeter::take(Layer& layer, std::int64_t frame, const Image& image, const Image& reference,
                        const Image* second, const std::vector<char>& counts) {
  const std::vector<float> a = layer_values(image, layer.name), b = layer_values(reference, layer.name);
  const std::vector<float> c = second ? layer_values(*second, layer.name) : std::vector<float>{};
  std::rotate(std::begin(layer.d), std::begin(layer.d) + 1, std::end(layer.d));
  std::rotate(std::begin(layer.second), std::begin(layer.second) + 1, std::end(layer.second));
  layer.d[2].assign(a.size(), kLeftOut);
  if (second) layer.second[2].assign(a.size(), kLeftOut);
  Sums sums;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!counts[i]) {
      ++sums.ignored;
    } else if (!std::isfinite(a[i]) || !std::isfinite(b[i])) {
      ++sums.non_finite;
    } else {
      const double d = double{a[i]} - b[i];
      layer.d[2][i] = static_cast<float>(d);
      ++sums.n;
      sums.d += d, sums.dd += d * d, sums.reference += std::fabs(double{b[i]});
      if (!second || !std::isfinite(c[i])) continue;
      const double e = double{a[i]} - c[i];
      layer.second[2][i] = static_cast<float>(e);
      ++sums.n_converged, sums.converged += d * e;
    }
  }
  Sums& all = layer.sums;
  all.d += sums.d, all.dd += sums.dd, all.reference += sums.reference, all.converged += sums.converged;
  all.n += sums.n, all.n_converged += sums.n_converged;
  all.ignored += sums.ignored, all.non_finite += sums.non_finite;
  if (added_ >= 3) {
    const double flicker = add_high_frequencies(layer);
    // The row of the frame in the middle was the last of this layer.
    frames_[frames_.size() - layers_.size()].flicker = flicker;
  }
  frames_.push_back({frame, layer_label(layer.name), mean(sums.reference, sums.n),
                     root(mean(sums.dd, sums.n)), mean(sums.d, sums.n)});
}

double FlickerMeter::add_high_frequencies(Layer& layer) const {
  double sum = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < layer.hh.size(); ++i) {
    const double h = high_frequency(layer.d, i);
    if (std::isnan(h)) continue;
    layer.hh[i] += h * h, ++layer.n[i];
    sum += h * h, ++n;
    if (!two_references_) continue;
    const double other = high_frequency(layer.second, i);
    if (std::isnan(other)) continue;
    layer.hh_second[i] += h * other, ++layer.n_second[i];
  }
  return root(kWhite * mean(sum, n));
}

std::vector<FlickerMetrics> FlickerMeter::metrics() const {
  std::vector<FlickerMetrics> all;
  for (const Layer& layer : layers_) {
    const Sums& s = layer.sums;
    FlickerMetrics m;
    m.layer = layer_label(layer.name), m.unit = layer_unit(layer.name);
    m.pixels = s.n, m.ignored = s.ignored, m.non_finite = s.non_finite;
    m.reference_mean = mean(s.reference, s.n);
    m.rmse = root(mean(s.dd, s.n)), m.bias = mean(s.d, s.n);
    const auto mean_over_all = [](const std::vector<double>& sums, const std::vector<std::uint32_t>& counts) {
      double sum = 0;
      std::size_t n = 0;
      for (std::size_t i = 0; i < sums.size(); ++i) sum += sums[i], n += counts[i];
      return mean(sum, n);
    };
    m.flicker = root(kWhite * mean_over_all(layer.hh, layer.n));
    m.relative_rmse = ratio(m.rmse, m.reference_mean), m.relative_bias = ratio(m.bias, m.reference_mean);
    m.relative_flicker = ratio(m.flicker, m.reference_mean);
    if (two_references_) {
      m.converged_rmse = root(mean(s.converged, s.n_converged));
      m.converged_flicker = root(kWhite * mean_over_all(layer.hh_second, layer.n_second));
      m.relative_converged_rmse = ratio(*m.converged_rmse, m.reference_mean);
      m.relative_converged_flicker = ratio(*m.converged_flicker, m.reference_mean);
    }
    all.push_back(std::move(m));
  }
  return all;
}

Image FlickerMeter::picture() const {
  Image out(width_, height_);
  for (const Layer& layer : layers_) {
    const bool plain = layer.components[0].empty();
    const std::span<float> values = out.channel(plain ? layer.name : channel_name(layer.name, "Y"));
    const std::vector<double>& sums = two_references_ ? layer.hh_second : layer.hh;
    const std::vector<std::uint32_t>& n = two_references_ ? layer.n_second : layer.n;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>(root(kWhite * mean(sums[i], n[i])));
  }
  return out;
}

FlickerMeter measure_flicker(const FramePattern& images, const FramePattern& references,
                             const FramePattern* seconds, const FrameRange& range,
                             const CompareOptions& options) {
  FlickerMeter meter(options);
  Progress progress("compare", static_cast<std::uint64_t>(range.count()), "frames");
  for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
    throw_if_interrupted();
    const Image image = read_image(images.path(frame)), reference = read_image(references.path(frame));
    std::optional<Image> second;
    if (seconds) second = read_image(seconds->path(frame));
    try {
      meter.add(frame, image, reference, second ? &*second : nullptr);
    } catch (const Error& e) {
      throw Error(e.code(), images.path(frame) + (e.where().empty() ? "" : ": " + e.where()), e.what());
    }
    progress.advance();
  }
  return meter;
}

Picture flicker_picture(const FlickerMeter& meter, std::size_t layer, std::optional<double> most) {
  const FlickerMetrics m = meter.metrics().at(layer);
  const Image flicker = meter.picture();
  const std::string name = layer_from_label(m.layer);
  const std::vector<float> values = layer_values(flicker, name.empty() ? "Y" : name);
  const FalseColourRange range = false_colour_range(values, Scale::linear, 0.0, most);
  return false_colour(values, flicker.width(), flicker.height(), range, Palette::viridis,
                      "flicker, " + m.layer, m.unit);
}

Json to_json(const FlickerMetrics& m) {
  Json j;
  j["layer"] = m.layer, j["unit"] = m.unit;
  j["pixels"] = m.pixels, j["ignored"] = m.ignored, j["non_finite"] = m.non_finite;
  j["reference_mean"] = m.reference_mean;
  j["rmse"] = m.rmse, j["relative_rmse"] = m.relative_rmse;
  j["bias"] = m.bias, j["relative_bias"] = m.relative_bias;
  j["flicker"] = m.flicker, j["relative_flicker"] = m.relative_flicker;
  if (!m.converged_rmse) return j;
  j["converged_rmse"] = *m.converged_rmse, j["relative_converged_rmse"] = *m.relative_converged_rmse;
  j["converged_flicker"] = *m.converged_flicker;
  j["relative_converged_flicker"] = *m.relative_converged_flicker;
  return j;
}

std::string to_table(const std::vector<FlickerMetrics>& metrics) {
  const auto row = [](const auto&... v) {
    char line[256];
    std::snprintf(line, sizeof line, "%-12s %-6s %10s %9s %10s %9s %10s %11s\n", v...);
    return std::string(line);
  };
  const auto number = [](double v) {
    char s[32];
    std::snprintf(s, sizeof s, "%.4g", v);
    return std::string(s);
  };
  std::string out = row("layer", "unit", "rmse", "rel.rmse", "bias", "rel.bias", "flicker", "rel.flicker");
  for (const FlickerMetrics& m : metrics) {
    out += row(m.layer.c_str(), m.unit.c_str(), number(m.rmse).c_str(), number(m.relative_rmse).c_str(),
               number(m.bias).c_str(), number(m.relative_bias).c_str(), number(m.flicker).c_str(),
               number(m.relative_flicker).c_str());
    if (m.converged_rmse)
      out += text("  without the references' noise: rmse ", number(*m.converged_rmse), ", relative ",
                  number(*m.relative_converged_rmse), "; flicker ", number(*m.converged_flicker),
                  ", relative ", number(*m.relative_converged_flicker), "\n");
    if (m.ignored > 0) out += text("  ", m.ignored, " pixels left out\n");
    if (m.non_finite > 0) out += text("  ", m.non_finite, " pixels are not finite\n");
  }
  return out;
}

std::string to_csv(const std::vector<FrameMetrics>& frames) {
  std::string csv =
      "frame,layer,reference_mean,rmse,relative_rmse,bias,relative_bias,flicker,relative_flicker\n";
  for (const FrameMetrics& f : frames) {
    csv += text(f.frame, ',', f.layer);
    const auto cell = [&csv](double v) { csv += ',' + (std::isnan(v) ? "" : shortest(v)); };
    cell(f.reference_mean);
    cell(f.rmse), cell(ratio(f.rmse, f.reference_mean));
    cell(f.bias), cell(ratio(f.bias, f.reference_mean));
    cell(f.flicker), cell(std::isnan(f.flicker) ? f.flicker : ratio(f.flicker, f.reference_mean));
    csv += '\n';
  }
  return csv;
}

}  // namespace phos::inline image
