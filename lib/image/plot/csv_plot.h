// A plot of the columns of a table.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/options.h"
#include "file/csv.h"
#include "image/plot/plot.h"

namespace phos::inline image {

struct CsvPlotOptions {
  std::string x, series;
  std::vector<std::string> y, where;
  std::string title, x_label, y_label;  ///< "": none; the columns' names
  bool log_x = false, log_y = false;
  std::optional<double> x_min, x_max, y_min, y_max;
  std::int64_t width = 720, height = 450;
};
void declare_options(Options& options, CsvPlotOptions& plot);
/// Options::first_given() of these.
std::string given_plot_option(const Options& options);

/// One line for each column of `y` and each value of the `series` column, in the order in which they first
/// appear; points by ascending x, and points of one x as they stand in the table. Throws Error(usage) for a
/// column that the table lacks, Error(bad_input) for a cell that is no number, or where no row is left.
Plot plot_of(const CsvTable& table, const CsvPlotOptions& options);

}  // namespace phos::inline image
