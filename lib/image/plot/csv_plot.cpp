#include "image/plot/csv_plot.h"

#include <algorithm>

#include "core/error.h"
#include "core/text/append_item.h"

namespace phos::inline image {

namespace {

/// COLUMN=VALUE: which rows stay.
struct Condition {
  std::size_t column;
  std::string value;
};

std::vector<Condition> conditions_of(const CsvTable& table, const std::vector<std::string>& where) {
  std::vector<Condition> all;
  for (const std::string& w : where) {
    const std::size_t at = w.find('=');
    if (at == std::string::npos)
      throw Error(ExitCode::usage, "--where", text("\"", w, "\" is not of the form COLUMN=VALUE"));
    all.push_back({table.column(w.substr(0, at), "--where"), w.substr(at + 1)});
  }
  return all;
}

std::vector<std::size_t> rows_of(const CsvTable& table, const std::vector<std::string>& where) {
  const std::vector<Condition> all = conditions_of(table, where);
  std::vector<std::size_t> rows;
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (std::all_of(all.begin(), all.end(),
                    [&](const Condition& c) { return table.rows[r][c.column] == c.value; }))
      rows.push_back(r);
  if (rows.empty())
    throw Error(ExitCode::bad_input, table.where,
                where.empty() ? "has no rows" : "has no row that --where asks for");
  return rows;
}

std::string name_of_line(const std::string& series, const std::string& y, bool several) {
  if (series.empty()) return several ? y : "";
  return several ? text(series, ", ", y) : series;
}

PlotLine& line_named(std::vector<PlotLine>& lines, const std::string& name) {
  for (PlotLine& line : lines)
    if (line.name == name) return line;
  lines.push_back({name, {}});
  return lines.back();
}

}  // namespace

void declare_options(Options& o, CsvPlotOptions& p) {
  o.section("Plots of a table");
  o.text("x", p.x, "COLUMN", "column along the x axis");
  o.list("y", p.y, "COLUMN", "column along the y axis; several columns make several lines");
  o.text("series", p.series, "COLUMN", "draw a line for each value of this column");
  o.list("where", p.where, "COLUMN=VALUE",
         "draw only rows with this value; several conditions must all hold");
  o.flag("log-x", p.log_x, "logarithmic x axis");
  o.flag("log-y", p.log_y, "logarithmic y axis");
  o.number("x-min", p.x_min, "X", "left end of the x axis (default: from the points)");
  o.number("x-max", p.x_max, "X", "right end of the x axis (default: from the points)");
  o.number("y-min", p.y_min, "Y", "lower end of the y axis (default: from the points)");
  o.number("y-max", p.y_max, "Y", "upper end of the y axis (default: from the points)");
  o.text("title", p.title, "TEXT", "title above the plot (default: none)");
  o.text("x-label", p.x_label, "TEXT", "label of the x axis (default: the name of the column)");
  o.text("y-label", p.y_label, "TEXT", "label of the y axis (default: the names of the columns)");
  o.integer("plot-width", p.width, "PIXELS", "width of the plot; a PNG has twice as many pixels",
            {320, 8192});
  o.integer("plot-height", p.height, "PIXELS", "height of the plot; a PNG has twice as many pixels",
            {200, 8192});
}

std::string given_plot_option(const Options& options) {
  return options.first_given({"x", "y", "series", "where", "log-x", "log-y", "x-min", "x-max", "y-min",
                              "y-max", "title", "x-label", "y-label", "plot-width", "plot-height"});
}

Plot plot_of(const CsvTable& table, const CsvPlotOptions& o) {
  const std::size_t x = table.column(o.x, "--x");
  std::vector<std::size_t> ys;
  for (const std::string& y : o.y) ys.push_back(table.column(y, "--y"));
  const std::size_t series = o.series.empty() ? 0 : table.column(o.series, "--series");

  Plot plot;
  const auto scale = [](bool log) { return log ? Scale::logarithmic : Scale::linear; };
  plot.title = o.title;
  plot.x = {o.x_label.empty() ? o.x : o.x_label, scale(o.log_x), o.x_min, o.x_max};
  plot.y = {o.y_label, scale(o.log_y), o.y_min, o.y_max};
  if (o.y_label.empty())
    for (const std::string& y : o.y) append_item(plot.y.label, y);
  plot.width = static_cast<int>(o.width), plot.height = static_cast<int>(o.height);

  for (const std::size_t row : rows_of(table, o.where)) {
    const std::string value = o.series.empty() ? "" : table.rows[row][series];
    for (std::size_t k = 0; k < ys.size(); ++k)
      line_named(plot.lines, name_of_line(value, o.y[k], ys.size() > 1))
          .points.push_back({table.number(row, x), table.number(row, ys[k])});
  }
  for (PlotLine& line : plot.lines) {
    // Points without an x are not shown, and must not break the order.
    const auto shown = std::stable_partition(line.points.begin(), line.points.end(),
                                             [](const PlotPoint& p) { return p.x == p.x; });
    std::stable_sort(line.points.begin(), shown,
                     [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
  }
  return plot;
}

}  // namespace phos::inline image
