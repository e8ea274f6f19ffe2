#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

#include "core/error.h"
#include "core/text/append_item.h"

namespace phos::inline image {

namespace {

std::span<const float> values_of(const Image& image, const std::string& layer, const std::string& component) {
  return image.channel(component.empty() ? layer : channel_name(layer, component));
}

std::string list(const std::vector<std::string>& layers) {
  std::string s;
  for (const std::string& l : layers) append_item(s, layer_label(l));
  return s.empty() ? "none" : s;
}

/// Clears the pixels that are not finite in either image, and returns their number.
std::size_t leave_out_non_finite(const Image& image, const Image& reference, const std::string& layer,
                                 const std::vector<std::string>& components, std::vector<char>& counts) {
  std::vector<char> bad(counts.size(), 0);
  for (const std::string& c : components)
    for (const Image* one : {&image, &reference}) {
      const std::span<const float> v = values_of(*one, layer, c);
      for (std::size_t i = 0; i < bad.size(); ++i) bad[i] |= std::isfinite(v[i]) ? char{0} : char{1};
    }
  std::size_t n = 0;
  for (std::size_t i = 0; i < bad.size(); ++i)
    if (bad[i]) counts[i] = 0, ++n;
  return n;
}

double ratio(double part, double whole) {
  if (part == 0) return 0;
  return whole > 0 ? part / whole : std::copysign(std::numeric_limits<double>::infinity(), part);
}

void measure_component(LayerMetrics& m, std::span<const float> a, std::span<const float> b,
                       const std::vector<char>& counts, std::vector<float>& absolute) {
  double sum_a = 0, sum_b = 0, squares = 0, relative_squares = 0, relative = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!counts[i]) continue;
    const double d = double{a[i]} - b[i], r = std::fabs(double{b[i]});
    sum_a += a[i], sum_b += b[i], squares += d * d;
    relative_squares += ratio(d * d, r * r + m.epsilon * m.epsilon);
    relative += ratio(std::fabs(d), r + m.epsilon);
    absolute.push_back(static_cast<float>(std::fabs(d)));
  }
  const double n = m.pixels == 0 ? 1.0 : static_cast<double>(m.pixels);
  const double share = 1 / static_cast<double>(m.components.size());
  m.mean.push_back(sum_a / n), m.reference_mean.push_back(sum_b / n);
  m.bias += share * (sum_a - sum_b) / n;
  m.rmse += share * squares / n;  // squared until every component is in
  m.relative_mse += share * relative_squares / n;
  m.mean_relative_error += share * relative / n;
}

double mean_magnitude(const Image& reference, const std::string& layer, const LayerMetrics& m,
                      const std::vector<char>& counts) {
  double sum = 0;
  for (const std::string& c : m.components) {
    const std::span<const float> v = values_of(reference, layer, c);
    for (std::size_t i = 0; i < v.size(); ++i)
      if (counts[i]) sum += std::fabs(double{v[i]});
  }
  return m.pixels == 0 ? 0.0 : sum / static_cast<double>(m.pixels * m.components.size());
}

Pu21 visual_difference(const Image& image, const Image& reference, const std::string& layer,
                       const std::vector<char>& counts) {
  const std::vector<Rgb> a = image.rgb(layer), b = reference.rgb(layer);
  std::vector<float> ya(a.size()), yb(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    yb[i] = is_finite(b[i]) ? luminance(b[i]) : 0.0f;
    ya[i] = counts[i] ? luminance(a[i]) : yb[i];
  }
  return compare_pu21(ya, yb, counts, image.width(), image.height());
}

std::vector<Rgb> errors_of(const Image& image) {
  return image.has_layer("stderr") ? image.rgb("stderr") : std::vector<Rgb>(image.pixels(), Rgb(0));
}

double share_of_outliers(const LayerMetrics& m, const Image& image, const Image& reference,
                         const std::vector<char>& counts) {
  constexpr double kOff = 0.2, kStandardErrors = 5;
  const std::vector<Rgb> a = image.rgb(""), b = reference.rgb(""), ea = errors_of(image),
                         eb = errors_of(reference);
  std::size_t found = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!counts[i]) continue;
    const double want = luminance(b[i]), off = std::fabs(luminance(a[i]) - want);
    const double noise = std::hypot(luminance(ea[i]), luminance(eb[i]));
    found += off > kOff * std::max(std::fabs(want), m.epsilon) && !(off <= kStandardErrors * noise);
  }
  return m.pixels == 0 ? 0 : static_cast<double>(found) / static_cast<double>(m.pixels);
}

/// The noise of two references is independent, and averages out of the product of their differences.
void measure_converged(LayerMetrics& m, const Image& image, const Image& reference, const Image& second,
                       const std::string& layer, const std::vector<char>& counts, double magnitude) {
  if (components_of(second, layer) != m.components)
    throw Error(ExitCode::mismatch, "second reference",
                text("has no layer ", m.layer, " like the reference's; make it with the same options"));
  double sum = 0;
  for (const std::string& c : m.components) {
    const std::span<const float> a = values_of(image, layer, c), b = values_of(reference, layer, c),
                                 other = values_of(second, layer, c);
    for (std::size_t i = 0; i < a.size(); ++i)
      if (counts[i] && std::isfinite(other[i])) sum += (double{a[i]} - b[i]) * (double{a[i]} - other[i]);
  }
  const auto n = static_cast<double>(std::max<std::size_t>(m.pixels, 1) * m.components.size());
  m.converged_rmse = std::sqrt(std::max(0.0, sum / n));
  m.relative_converged_rmse = ratio(*m.converged_rmse, magnitude);
}

LayerMetrics measure(const Image& image, const Image& reference, const Image* second,
                     const std::string& layer, std::vector<char> counts) {
  LayerMetrics m;
  m.layer = layer_label(layer), m.unit = layer_unit(layer);
  m.components = components_of(reference, layer);
  m.ignored = static_cast<std::size_t>(std::count(counts.begin(), counts.end(), 0));
  m.non_finite = leave_out_non_finite(image, reference, layer, m.components, counts);
  m.pixels = static_cast<std::size_t>(std::count(counts.begin(), counts.end(), 1));
  const double magnitude = mean_magnitude(reference, layer, m, counts);
  m.epsilon = 0.01 * magnitude;
  std::vector<float> absolute;
  absolute.reserve(m.pixels * m.components.size());
  for (const std::string& c : m.components)
    measure_component(m, values_of(image, layer, c), values_of(reference, layer, c), counts, absolute);
  m.rmse = std::sqrt(m.rmse);
  m.relative_rmse = ratio(m.rmse, magnitude);
  m.relative_bias = ratio(m.bias, magnitude);
  if (second) measure_converged(m, image, reference, *second, layer, counts, magnitude);
  if (!absolute.empty()) {
    const auto at =
        absolute.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(absolute.size() - 1) + 0.5);
    std::nth_element(absolute.begin(), at, absolute.end());
    m.p99 = *at, m.max = *std::max_element(at, absolute.end());
  }
  if (m.unit == "cd/m2" && m.components.size() == 3)
    m.visual = visual_difference(image, reference, layer, counts);
  if (layer.empty()) m.outliers = share_of_outliers(m, image, reference, counts);
  return m;
}

}  // namespace

std::string layer_label(const std::string& layer) { return layer.empty() ? "beauty" : layer; }
std::string layer_from_label(const std::string& label) {
  if (label == "beauty") return "";
  return label.ends_with(".Y") ? label.substr(0, label.size() - 2)
                               : label;  // "illuminance.Y" names its channel
}

std::string layer_unit(const std::string& layer) {
  if (layer == "illuminance") return "lx";
  if (layer == "position" || layer == "Z") return "m";
  if (layer == "albedo" || layer == "normal" || layer == "weight" || layer == "A" || layer == "material")
    return "1";
  return "cd/m2";
}

std::vector<std::string> components_of(const Image& image, const std::string& layer) {
  if (layer.empty())
    return image.has_layer("") ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{};
  if (image.has(layer)) return {""};
  if (image.has_layer(layer)) return {"R", "G", "B"};
  std::vector<std::string> components;
  for (const auto& [name, values] : image.channels())
    if (name.starts_with(layer + ".") && name.find('.', layer.size() + 1) == std::string::npos)
      components.push_back(name.substr(layer.size() + 1));
  return components;
}

std::vector<std::string> all_layers(const Image& image) {
  std::set<std::string> layers;
  if (image.has_layer("")) layers.insert("");
  for (const auto& [name, values] : image.channels()) {
    const std::size_t dot = name.rfind('.');
    if (dot != std::string::npos)
      layers.insert(name.substr(0, dot));
    else if (!image.has_layer("") || (name != "R" && name != "G" && name != "B"))
      layers.insert(name);
  }
  return {layers.begin(), layers.end()};
}

std::vector<std::string> common_layers(const Image& image, const Image& reference,
                                       const CompareOptions& options) {
  if (image.width() != reference.width() || image.height() != reference.height())
    throw Error(ExitCode::mismatch, "",
                text("the image is ", image.width(), " x ", image.height(), " pixels and the reference ",
                     reference.width(), " x ", reference.height(), "; render both at one size"));
  const std::vector<std::string> ours = all_layers(image);
  std::vector<std::string> both;
  for (const std::string& layer : ours)
    if (components_of(image, layer) == components_of(reference, layer)) both.push_back(layer);
  if (both.empty())
    throw Error(
        ExitCode::mismatch, "",
        text("no common layer (image: ", list(ours), "; reference: ", list(all_layers(reference)), ")"));
  if (options.layers.empty()) return both;
  std::vector<std::string> wanted;
  for (const std::string& label : options.layers) {
    const std::string layer = layer_from_label(label);
    if (std::find(both.begin(), both.end(), layer) == both.end())
      throw Error(ExitCode::mismatch, "",
                  text("layer \"", label, "\" is not in both images; common are: ", list(both)));
    if (std::find(wanted.begin(), wanted.end(), layer) == wanted.end()) wanted.push_back(layer);
  }
  std::sort(wanted.begin(), wanted.end());
  return wanted;
}

bool show_emission(Pictures pictures) {
  return std::any_of(pictures.begin(), pictures.end(),
                     [](const Image* p) { return p && p->has_layer("emission"); });
}

std::vector<char> emission_mask(Pictures pictures, bool ignore_emission) {
  std::vector<char> mask((*pictures.begin())->pixels(), 1);
  if (!ignore_emission) return mask;
  if (!show_emission(pictures))
    throw Error(ExitCode::mismatch, "--ignore-emission",
                "neither image has the layer emission; leave the option out");
  for (const Image* picture : pictures) {
    if (!picture || !picture->has_layer("emission")) continue;
    const std::vector<Rgb> emission = picture->rgb("emission");
    for (std::size_t i = 0; i < mask.size(); ++i)
      if (emission[i] != Rgb(0)) mask[i] = 0;
  }
  return mask;
}

std::vector<LayerMetrics> compare_images(const Image& image, const Image& reference,
                                         const CompareOptions& options, const Image* second) {
  const std::vector<std::string> layers = common_layers(image, reference, options);
  if (second) common_layers(*second, reference, {.layers = options.layers});
  const std::vector<char> mask = emission_mask({&image, &reference, second}, options.ignore_emission);
  std::vector<LayerMetrics> all;
  for (const std::string& layer : layers) all.push_back(measure(image, reference, second, layer, mask));
  return all;
}

Image difference_image(const Image& image, const Image& reference, const CompareOptions& options) {
  const std::vector<std::string> layers = common_layers(image, reference, options);
  const std::vector<char> mask = emission_mask({&image, &reference}, options.ignore_emission);
  Image out(image.width(), image.height());
  for (const std::string& layer : layers)
    for (const std::string& c : components_of(reference, layer)) {
      const std::span<const float> a = values_of(image, layer, c), b = values_of(reference, layer, c);
      const std::span<float> d = out.channel(c.empty() ? layer : channel_name(layer, c));
      for (std::size_t i = 0; i < d.size(); ++i)
        d[i] = mask[i] && std::isfinite(a[i]) && std::isfinite(b[i]) ? a[i] - b[i] : 0.0f;
    }
  return out;
}

Json to_json(const LayerMetrics& m) {
  Json j;
  j["layer"] = m.layer, j["unit"] = m.unit;
  j["pixels"] = m.pixels, j["ignored"] = m.ignored, j["non_finite"] = m.non_finite;
  for (std::size_t i = 0; i < m.components.size(); ++i) {
    const std::string name = m.components[i].empty() ? m.layer : m.components[i];
    j["mean"][name] = m.mean[i], j["reference_mean"][name] = m.reference_mean[i];
  }
  j["rmse"] = m.rmse, j["relative_rmse"] = m.relative_rmse, j["relative_mse"] = m.relative_mse;
  j["mean_relative_error"] = m.mean_relative_error, j["bias"] = m.bias, j["relative_bias"] = m.relative_bias;
  j["p99"] = m.p99, j["max"] = m.max, j["epsilon"] = m.epsilon;
  if (m.converged_rmse)
    j["converged_rmse"] = *m.converged_rmse, j["relative_converged_rmse"] = *m.relative_converged_rmse;
  if (m.outliers) j["outliers"] = *m.outliers;
  if (m.visual) j["pu21_psnr_db"] = m.visual->psnr_db, j["pu21_ssim"] = m.visual->ssim;
  return j;
}

std::string to_table(const std::vector<LayerMetrics>& metrics) {
  const auto row = [](const auto&... v) {
    char line[256];
    std::snprintf(line, sizeof line, "%-12s %-6s %10s %9s %9s %9s %10s %9s %10s %10s %8s %7s", v...);
    std::string s = line;
    s.erase(s.find_last_not_of(' ') + 1);
    return s + "\n";
  };
  const auto number = [](double v) {
    char s[32];
    std::snprintf(s, sizeof s, "%.4g", v);
    return std::string(s);
  };
  std::string out = row("layer", "unit", "rmse", "rel.rmse", "rel.mse", "rel.err", "bias", "rel.bias", "p99",
                        "max", "PU.psnr", "PU.ssim");
  for (const LayerMetrics& m : metrics) {
    out += row(m.layer.c_str(), m.unit.c_str(), number(m.rmse).c_str(), number(m.relative_rmse).c_str(),
               number(m.relative_mse).c_str(), number(m.mean_relative_error).c_str(), number(m.bias).c_str(),
               number(m.relative_bias).c_str(), number(m.p99).c_str(), number(m.max).c_str(),
               m.visual ? number(m.visual->psnr_db).c_str() : "",
               m.visual ? number(m.visual->ssim).c_str() : "");
    if (m.converged_rmse)
      out += text("  rmse without the references' noise ", number(*m.converged_rmse), ", relative ",
                  number(*m.relative_converged_rmse), "\n");
    if (m.outliers.value_or(0) > 0)
      out += text("  ", number(100 * *m.outliers),
                  " % of the pixels are off by 20 % in luminance and by 5 standard errors\n");
    if (m.ignored > 0) out += text("  ", m.ignored, " pixels left out\n");
    if (m.non_finite > 0) out += text("  ", m.non_finite, " pixels are not finite\n");
  }
  return out;
}

}  // namespace phos::inline image
