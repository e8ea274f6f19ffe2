// Lines of equal value on a grid.
#pragma once

#include <cstddef>
#include <vector>

#include "image/canvas.h"

namespace phos::inline image {

/// Values at the places (0, 0) .. (width - 1, height - 1), row by row; NaN where there is none.
struct GridField {
  int width = 0, height = 0;
  std::vector<double> values;  ///< width * height

  double at(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// Where the field, linear between neighbours along rows and columns, has the value `level`: lines in the
/// units of the grid, the last point equal to the first where a line is closed. A cell of four finite values
/// has lines (marching squares: W. Lorensen and H. Cline 1987, in two dimensions); where two cross it, its
/// mean says which corners are joined. Open lines come before closed ones.
std::vector<std::vector<PlotPoint>> contour_lines(const GridField& field, double level);

/// Multiples of one round number, above 0 and below `most`: two to seven of them. None where `most` is not
/// above 0 or not finite.
std::vector<double> round_levels(double most);

}  // namespace phos::inline image
