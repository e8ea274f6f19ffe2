// Line plots, as SVG and as pixels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/canvas.h"
#include "image/false_colour.h"

namespace phos::inline image {

/// Points joined in the order given. One that is not finite, or not above 0 on a logarithmic axis, is left
/// out, and the line is broken there.
struct PlotLine {
  std::string name;  ///< in the legend; "" is not listed
  std::vector<PlotPoint> points;
  bool joined = true;  ///< else marks alone
  /// Upright, from lo to hi at x: how far a point is known. Shown as points are; none where it is not.
  struct Bar {
    double x = 0, lo = 0, hi = 0;
  };
  std::vector<Bar> bars{};
};

struct PlotAxis {
  std::string label;  ///< with its unit
  Scale scale = Scale::linear;
  std::optional<double> min, max;  ///< else from the points, and to round numbers
};

struct Plot {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotLine> lines;
  int width = 720, height = 450;  ///< pixels, at least 320 x 200
};

/// How many points cannot be shown (see PlotLine).
std::size_t points_left_out(const Plot& plot);

/// Axes with round numbers, a grid, a legend at the right where lines have names, and a mark at each point
/// where there are few. The same plot gives the same bytes. Throws Error(usage) for an axis that is empty
/// (min not below max, or a logarithmic one that does not start above 0), Error(bad_input) if no point can be
/// shown.
std::string plot_svg(const Plot& plot);
/// The same drawing, `scale` times as many pixels each way.
Picture plot_picture(const Plot& plot, int scale = 1);

}  // namespace phos::inline image
