#include "image/false_colour.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

#include "core/error.h"
#include "core/text/append_item.h"
#include "image/canvas.h"
#include "image/metrics.h"
#include "image/plot/style.h"

namespace phos::inline image {

namespace {

constexpr Colour8 kBackground{32, 32, 36}, kBright{235, 235, 235}, kFaint{150, 150, 155};

Colour8 to_bytes(const glm::dvec3& c) {
  Colour8 out;
  for (int i = 0; i < 3; ++i)
    out[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(255 * std::clamp(c[i], 0.0, 1.0) + 0.5);
  return out;
}

glm::dvec3 polynomial(std::initializer_list<glm::dvec3> lowest_first, double t) {
  glm::dvec3 sum(0);
  for (auto c = std::rbegin(lowest_first); c != std::rend(lowest_first); ++c) sum = sum * t + *c;
  return sum;
}

float percentile(std::vector<float>& values, double fraction) {
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Where a value lies on the scale, 0 .. 1 between its ends.
double position(const FalseColourRange& r, double v) {
  if (r.scale == Scale::linear) return (v - r.lo) / (r.hi - r.lo);
  return v > 0 ? std::log(v / r.lo) / std::log(r.hi / r.lo) : -1.0;
}

double value_at(const FalseColourRange& r, double t) {
  return r.scale == Scale::linear ? r.lo + t * (r.hi - r.lo) : r.lo * std::pow(r.hi / r.lo, t);
}

/// "0.25", "1500", "2.5e+07": never more than four digits that count.
std::string number(double v) {
  char s[32];
  const double size = std::fabs(v);
  if (size >= 1000 && size < 1e6)
    std::snprintf(s, sizeof s, "%.0f", v);
  else
    std::snprintf(s, sizeof s, "%.4g", size < 1e-12 ? 0.0 : v);
  return s;
}

/// "mean 17.2" and the extremes of the finite values, which the palette may not reach.
std::vector<std::string> figures_of(std::span<const float> values) {
  double sum = 0, lo = kInfinity, hi = -kInfinity;
  std::size_t n = 0, bad = 0;
  for (const float v : values) {
    if (!std::isfinite(v)) {
      ++bad;
      continue;
    }
    sum += v, lo = std::min(lo, double{v}), hi = std::max(hi, double{v});
    ++n;
  }
  std::vector<std::string> lines;
  if (n > 0)
    lines = {"max " + number(hi), "mean " + number(sum / static_cast<double>(n)), "min " + number(lo)};
  if (bad > 0) lines.push_back(text("not finite ", bad));
  return lines;
}

std::string shown_unit(std::string unit) {
  if (unit == "1") return "";
  for (std::size_t at = unit.find("m2"); at != std::string::npos; at = unit.find("m2", at))
    unit.replace(at, 2, "m\xc2\xb2");
  return unit;
}

/// Tops of both at the top.
Picture side_by_side(const Picture& left, const Picture& right) {
  Picture out = make_picture(left.width + right.width, std::max(left.height, right.height), kBackground);
  const auto copy = [&out](const Picture& from, int x) {
    for (int y = 0; y < from.height; ++y)
      std::copy_n(from.rgb.begin() + std::ptrdiff_t{3} * y * from.width, 3 * from.width,
                  out.rgb.begin() + std::ptrdiff_t{3} * (std::ptrdiff_t{y} * out.width + x));
  };
  copy(left, 0), copy(right, left.width);
  return out;
}

Picture coloured(std::span<const float> values, int width, int height, const FalseColourRange& range,
                 const std::function<Colour8(double)>& colour) {
  constexpr int kSteps = 1024;
  std::vector<Colour8> table;
  for (int i = 0; i <= kSteps; ++i) table.push_back(colour(static_cast<double>(i) / kSteps));
  Picture out = make_picture(width, height, kNotFinite);
  PHOS_CHECK(out.rgb.size() == 3 * values.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const double t = std::clamp(position(range, values[i]), 0.0, 1.0);
    const Colour8& c = table[static_cast<std::size_t>(t * kSteps + 0.5)];
    std::copy(c.begin(), c.end(), out.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  return out;
}

}  // namespace

Picture with_legend(const Picture& picture, const FalseColourRange& range, const LegendText& words,
                    const std::function<Colour8(double)>& colour) {
  // Letters grow with the picture. A line of words takes `line` pixels.
  const int size = letters_of_picture(picture.height), line = size * 4 / 3, gap = size / 2;
  const std::size_t lines = words.steady ? 4 : words.figures.size();
  const int footer = static_cast<int>(lines) * line;
  const int height = std::min(std::max(picture.height, 14 * line + footer), kMostCanvasPixels);
  const int top = gap + 2 * line + line / 2, bottom = height - footer - gap - line / 2;
  const int bar_width = line, bar_height = bottom - top;
  const std::string unit = shown_unit(words.unit);
  const Canvas ruler = Canvas::pixels(1, 1, kBackground);
  const auto width_of = [&](const std::string& s) {
    return static_cast<int>(std::ceil(ruler.width_of(s, size)));
  };
  std::vector<std::pair<double, std::string>> marks;
  int widest = std::max(width_of(words.title), width_of(unit));
  if (words.steady) widest = std::max(widest, width_of("not finite 12345678"));
  for (const std::string& s : words.figures) widest = std::max(widest, width_of(s));
  for (const double v : scale_marks(range, std::clamp(bar_height / (2 * line), 2, 14))) {
    marks.emplace_back(v, number(v));
    widest = std::max(widest, bar_width + 2 * gap + width_of(marks.back().second));
  }
  Canvas legend = Canvas::pixels(gap + widest + gap, height, kBackground);
  const auto write = [&](int x, int middle, const std::string& s, const Colour8& ink) {
    legend.write({static_cast<double>(x), static_cast<double>(middle)}, s,
                 {.colour = ink, .size = static_cast<double>(size)});
  };
  write(gap, gap + line / 2, words.title, kBright);
  write(gap, gap + line + line / 2, unit, kFaint);
  legend.fill(gap - 1, top - 1, bar_width + 2, bar_height + 2, kFaint);
  for (int y = 0; y < bar_height; ++y)
    legend.fill(gap, top + y, bar_width, 1, colour(1 - (y + 0.5) / bar_height));
  for (const auto& [v, label] : marks) {
    const int y = top + static_cast<int>(std::lround((1 - position(range, v)) * bar_height));
    const int thick = std::max(1, size / 12);
    legend.fill(gap + bar_width, y - thick / 2, gap, thick, kBright);
    write(gap + bar_width + gap + gap / 2, y, label, kBright);
  }
  for (std::size_t i = 0; i < words.figures.size(); ++i)
    write(gap, height - footer - gap + static_cast<int>(i) * line + line / 2, words.figures[i], kFaint);
  return side_by_side(picture, legend.finish_picture());
}

double round_up_125(double v) {
  const double power = std::pow(10.0, std::floor(std::log10(v)));
  for (const double m : {1.0, 2.0, 5.0})
    if (v <= m * power * (1 + 1e-9)) return m * power;
  return 10 * power;
}

double round_down_125(double v) {
  const double power = std::pow(10.0, std::floor(std::log10(v)));
  for (const double m : {5.0, 2.0})
    if (v >= m * power * (1 - 1e-9)) return m * power;
  return power;
}

Colour8 palette_colour(Palette palette, double t) {
  t = std::clamp(t, 0.0, 1.0);
  switch (palette) {
    case Palette::viridis:
      return to_bytes(polynomial({{0.2777273272234177, 0.005407344544966578, 0.3340998053353061},
                                  {0.1050930431085774, 1.404613529898575, 1.384590162594685},
                                  {-0.3308618287255563, 0.214847559468213, 0.09509516302823659},
                                  {-4.634230498983486, -5.799100973351585, -19.33244095627987},
                                  {6.228269936347081, 14.17993336680509, 56.69055260068105},
                                  {4.776384997670288, -13.74514537774601, -65.35303263337234},
                                  {-5.435455855934631, 4.645852612178535, 26.3124352495832}},
                                 t));
    case Palette::turbo:
      return to_bytes(polynomial({{0.13572138, 0.09140261, 0.10667330},
                                  {4.61539260, 2.19418839, 12.64194608},
                                  {-42.66032258, 4.84296658, -60.58204836},
                                  {132.13108234, -14.18503333, 110.36276771},
                                  {-152.94239396, 4.27729857, -89.90310912},
                                  {59.28637943, 2.82956604, 27.34824973}},
                                 t));
    case Palette::grey:
      break;
  }
  return to_bytes(glm::dvec3(t));
}

Colour8 difference_colour(double t) {
  t = std::clamp(t, -1.0, 1.0);
  const glm::dvec3 white(0.97), far = t < 0 ? glm::dvec3(0.02, 0.19, 0.55) : glm::dvec3(0.55, 0.02, 0.10);
  const glm::dvec3 middle = t < 0 ? glm::dvec3(0.26, 0.57, 0.86) : glm::dvec3(0.93, 0.38, 0.30);
  const double s = std::fabs(t);
  return to_bytes(s < 0.5 ? glm::mix(white, middle, 2 * s) : glm::mix(middle, far, 2 * s - 1));
}

std::vector<float> layer_values(const Image& image, const std::string& layer) {
  const std::vector<std::string> components = components_of(image, layer);
  std::vector<float> values(image.pixels());
  if (components == std::vector<std::string>{"R", "G", "B"}) {
    const std::vector<Rgb> rgb = image.rgb(layer);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = luminance(rgb[i]);
    return values;
  }
  if (components.size() == 1) {
    const std::span<const float> v =
        image.channel(components[0].empty() ? layer : channel_name(layer, components[0]));
    values.assign(v.begin(), v.end());
    return values;
  }
  if (!components.empty())
    throw Error(ExitCode::bad_input, "",
                text("layer \"", layer, "\" is no single quantity; choose another with --layer"));
  std::string there;
  for (const std::string& l : all_layers(image)) append_item(there, layer_label(l));
  throw Error(ExitCode::bad_input, "",
              text("there is no layer \"", layer_label(layer), "\"; there are: ", there));
}

FalseColourRange false_colour_range(std::span<const float> values, Scale scale, std::optional<double> lo,
                                    std::optional<double> hi) {
  std::vector<float> usable;
  for (const float v : values)
    if (std::isfinite(v) && (v > 0 || scale == Scale::linear)) usable.push_back(v);
  FalseColourRange range{scale, 0, 1};
  const double high = percentile(usable, 0.98), low = percentile(usable, 0.01);
  range.hi = hi ? *hi : high > 0 ? round_up_125(high) : lo && *lo > 0 ? 10 * *lo : 1.0;
  if (lo)
    range.lo = *lo;
  else if (scale == Scale::logarithmic)
    range.lo = low > 0 && low < range.hi ? std::max(round_down_125(low), range.hi / 1e4) : range.hi / 100;
  else
    range.lo = low < 0 ? -round_up_125(-low) : 0;
  if (scale == Scale::logarithmic && !(range.lo > 0))
    throw Error(ExitCode::usage, "--min", "a logarithmic scale starts above 0");
  if (!(range.lo < range.hi))
    throw Error(ExitCode::usage, "--max",
                text("the scale from ", range.lo, " to ", range.hi, " is empty; give --min and --max"));
  return range;
}

std::vector<double> scale_marks(const FalseColourRange& range, int wanted) {
  std::vector<double> marks;
  if (range.scale == Scale::linear) {
    const double step = round_up_125((range.hi - range.lo) / wanted);
    const double slack = 1e-6 * step;
    for (double k = std::ceil((range.lo - slack) / step); k * step <= range.hi + slack; ++k)
      marks.push_back(k * step);
    return marks;
  }
  const double decades = std::log10(range.hi / range.lo);
  const bool fine = 3 * decades <= wanted, coarse = decades > wanted;
  const int stride = coarse ? static_cast<int>(std::ceil(decades / wanted)) : 1;
  const int first = static_cast<int>(std::floor(std::log10(range.lo))),
            last = static_cast<int>(std::ceil(std::log10(range.hi)));
  for (int e = first; e <= last; e += stride)
    for (const double m : {1.0, 2.0, 5.0}) {
      const double v = m * std::pow(10.0, e);
      if ((m == 1 || fine) && v >= range.lo * (1 - 1e-9) && v <= range.hi * (1 + 1e-9)) marks.push_back(v);
    }
  if (marks.size() < 2) marks = {range.lo, value_at(range, 0.5), range.hi};
  return marks;
}

Picture false_colour(std::span<const float> values, int width, int height, const FalseColourRange& range,
                     Palette palette, const std::string& title, const std::string& unit, bool steady) {
  const auto colour = [palette](double t) { return palette_colour(palette, t); };
  return with_legend(coloured(values, width, height, range, colour), range,
                     {title, unit, figures_of(values), steady}, colour);
}

Picture difference_picture(std::span<const float> values, int width, int height, double range,
                           const std::string& title, const std::string& unit) {
  if (range <= 0) {
    std::vector<float> sizes;
    for (const float v : values)
      if (std::isfinite(v)) sizes.push_back(std::fabs(v));
    const float most = percentile(sizes, 0.99);
    const float any = sizes.empty() ? 0.0f : *std::max_element(sizes.begin(), sizes.end());
    range = most > 0 ? round_up_125(most) : any > 0 ? round_up_125(any) : 1.0;
  }
  const FalseColourRange scale{Scale::linear, -range, range};
  const auto colour = [](double t) { return difference_colour(2 * t - 1); };
  return with_legend(coloured(values, width, height, scale, colour), scale,
                     {title, unit, figures_of(values), false}, colour);
}

}  // namespace phos::inline image
