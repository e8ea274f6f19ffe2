// Lines of equal value with labels, over a picture or as a plan.
#pragma once

#include <string>
#include <vector>

#include "image/plot/contours.h"

namespace phos::inline image {

struct ContouredPicture {
  Picture picture;
  std::vector<double> unlabelled;  ///< levels whose lines have no room for a label
};

/// Lines over a picture whose upper left part the field describes, a value for the middle of each pixel.
/// Labels are levels with `unit` ("" has none). `levels` ascend. Throws Error(bad_input) for a picture of
/// more than kMostCanvasPixels a side.
ContouredPicture contours_over(const Picture& picture, const GridField& field,
                               const std::vector<double>& levels, const std::string& unit);

/// A horizontal plane seen from above: x to the right, z downwards.
struct ContourPlan {
  GridField field;             ///< at least 2 x 2; row y holds z = z0_m + y * spacing_m
  double x0_m = 0, z0_m = 0;   ///< place of the first value
  double spacing_m = 1;        ///< between neighbours
  std::vector<double> levels;  ///< ascending
  std::string title, unit;
  int width = 720;  ///< pixels, at least 320; the height follows
};

/// Lines with labels, a frame with metres, and a legend of all levels. The same plan gives the same bytes.
std::string contour_plan_svg(const ContourPlan& plan);
/// The same drawing, `scale` times as many pixels each way.
Picture contour_plan_picture(const ContourPlan& plan, int scale = 1);

}  // namespace phos::inline image
