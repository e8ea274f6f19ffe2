// Functions on discs, side by side, with the scale of their colours.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "image/false_colour.h"

namespace phos::inline image {

struct Disc {
  std::string title;  ///< above it
  /// Value at a point of the unit disc: x to the right, y upwards. NaN: there is none.
  std::function<double(double x, double y)> value;
};

struct DiscPlot {
  std::vector<std::vector<Disc>> rows;  ///< each centred; one disc at least
  std::string title, unit;              ///< of the values, above the scale
  double lo = 0, hi = 1;                ///< values at the ends of the scale, which is linear
  bool about_zero = false;  ///< blue to white to red from -hi to hi, and `lo` is not read; else viridis
  std::string absent;       ///< name of places without a value, which are grey; "": all have one
  int diameter = 240;       ///< pixels, at least 16
};

inline constexpr Colour8 kAbsent{128, 128, 128};

/// A pixel has the colour of the value at its middle. The same plot gives the same bytes. Parallel. Throws
/// Error(bad_input) for a plot of more than kMostCanvasPixels a side.
Picture disc_plot_picture(const DiscPlot& plot);

}  // namespace phos::inline image
