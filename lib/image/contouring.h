// The options of lines of equal value, which they draw for layers of images and columns of tables.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/options.h"
#include "file/csv.h"
#include "image/image.h"
#include "image/plot/contour_plot.h"

namespace phos::inline image {

struct ContourOptions {
  std::string of;                   ///< a layer or a column; "": no lines
  std::vector<std::string> levels;  ///< numbers; none: round ones
  std::optional<double> spacing_m;  ///< of a table's grid
};
void declare_options(Options& options, ContourOptions& contours);
/// Options::first_given() of these.
std::string given_contour_option(const Options& options);
/// Throws Error(usage) for levels or a spacing without lines, levels that are no finite numbers, and a
/// spacing for an image (`table` false) or none for a table.
void check_usage(const ContourOptions& contours, bool table);

/// The options with the levels as they are for this image: round numbers up to the 98th percentile of the
/// layer, rounded up; none for a black layer. Throws Error(bad_input) as layer_values() does.
ContourOptions fixed_levels(const Image& image, const ContourOptions& contours);

/// Lines of the layer over a picture of the image, which may have a legend at its right. Throws as
/// fixed_levels() and contours_over() do.
ContouredPicture contoured(const Image& image, const Picture& picture, const ContourOptions& contours);

struct TableContours {
  ContourPlan plan;
  std::size_t hidden = 0;  ///< rows at whose place a later row stands
};
/// The plane of sensors in a table: columns x and z, m, on a grid of `spacing_m`, and the column `of`, whose
/// unit is lx where its name ends in "_lx". Throws Error(usage) for a column that is absent, Error(bad_input)
/// where no four sensors are neighbours or the grid has more than 2^24 places.
TableContours contours_of(const CsvTable& table, const ContourOptions& contours);

}  // namespace phos::inline image
