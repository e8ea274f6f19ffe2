// Polar plots as lighting people draw them: straight down is at the bottom, the value grows from the middle.
#pragma once

#include <string>
#include <vector>

#include "image/plot/plot.h"

namespace phos::inline image {

struct PolarCurve {
  std::string name;  ///< in the legend
  /// x: degrees from straight down, right positive, -180 .. 180; y: value, not negative. Joined in the order
  /// given.
  std::vector<PlotPoint> points;
};

struct PolarPlot {
  std::string title, unit;
  std::vector<PolarCurve> curves;
  std::vector<std::string> caption;  ///< lines below the plot
  int width = 720;                   ///< pixels, at least 400; the height follows
};

/// Circles at round values with labels, rays every 15 degrees with labels; of light that stays below 100
/// degrees only the lower part is drawn. The same plot gives the same bytes. Throws Error(bad_input) if no
/// value is above 0.
std::string polar_plot_svg(const PolarPlot& plot);
Picture polar_plot_picture(const PolarPlot& plot, int scale = 1);

}  // namespace phos::inline image
