// A quantity as colours, with a legend that says which colour is how much.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image/colour8.h"
#include "image/image.h"

namespace phos::inline image {

enum class Palette { viridis, turbo, grey };
enum class Scale { linear, logarithmic };

/// Colour of t in 0 .. 1 (clamped). viridis (S. van der Walt and N. Smith, 2015; degree-6 fit by M. Zucker)
/// rises evenly in lightness; turbo (A. Mikhailov, 2019; the author's degree-5 fit) sets more values apart
/// but is not even.
Colour8 palette_colour(Palette palette, double t);
/// Blue below zero, white at zero, red above; t in -1 .. 1.
Colour8 difference_colour(double t);

/// Loud, and in no palette: a value that is not finite.
inline constexpr Colour8 kNotFinite{255, 0, 255};

/// Scalar of a layer at each pixel: luminance of R, G, B, or the only component. Throws Error(bad_input) for
/// a layer that is absent or has no such scalar (normals).
std::vector<float> layer_values(const Image& image, const std::string& layer);

/// Values that the ends of the scale stand for.
struct FalseColourRange {
  Scale scale = Scale::linear;
  double lo = 0, hi = 1;
};

/// Fills in the values that are not given. hi is the 98th percentile of the finite values, rounded up to a
/// round number; lo is 0 on a linear scale, and on a logarithmic one the first percentile of positive values,
/// rounded down, at most 10,000 times below hi. Throws Error(usage) if lo >= hi, or if a logarithmic scale
/// does not start above 0.
FalseColourRange false_colour_range(std::span<const float> values, Scale scale, std::optional<double> lo,
                                    std::optional<double> hi);

/// The picture, with a legend at its right: title, unit, palette, and round numbers beside their colours;
/// below it mean and extremes, as the brightest pixels may lie beyond the palette. `steady`: of one size,
/// whatever these are.
Picture false_colour(std::span<const float> values, int width, int height, const FalseColourRange& range,
                     Palette palette, const std::string& title, const std::string& unit, bool steady = false);

/// Signed values, blue to white to red over -range .. range (0: the 99th percentile of |value|, rounded up).
Picture difference_picture(std::span<const float> values, int width, int height, double range,
                           const std::string& title, const std::string& unit);

struct LegendText {
  std::string title, unit;
  std::vector<std::string> figures;  ///< lines below the palette
  bool steady = false;               ///< room for any figures, so that every legend is of one size
};

/// The picture on a larger one with a legend at its right. `colour` gives the palette at a position 0 .. 1.
Picture with_legend(const Picture& picture, const FalseColourRange& range, const LegendText& words,
                    const std::function<Colour8(double)>& colour);

/// Values for the numbers of a scale: round ones, between lo and hi, about `wanted` of them.
std::vector<double> scale_marks(const FalseColourRange& range, int wanted);
/// 1, 2 or 5 times a power of ten, not below v (up) or not above it. v > 0.
double round_up_125(double v);
double round_down_125(double v);

}  // namespace phos::inline image
