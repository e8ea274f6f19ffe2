#include "image/contouring.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/error.h"
#include "image/false_colour.h"
#include "image/metrics.h"

namespace phos::inline image {

namespace {

constexpr double kMostPlaces = 1 << 24;

/// Ascending, each once.
std::vector<double> numbers_of(const std::vector<std::string>& levels) {
  std::vector<double> all;
  for (const std::string& word : levels) {
    char* end = nullptr;
    const double v = std::strtod(word.c_str(), &end);
    if (word.empty() || *end != '\0' || !std::isfinite(v))
      throw Error(ExitCode::usage, "--levels", text("\"", word, "\" is no number"));
    all.push_back(v);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// A place of the grid along one axis.
struct Ticks {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  void add(double v) { first = std::min(first, v), last = std::max(last, v); }
  double count(double spacing) const { return std::round((last - first) / spacing) + 1; }
  int index(double v, double spacing) const { return static_cast<int>(std::round((v - first) / spacing)); }
};

bool has_cell(const GridField& f) {
  for (int y = 0; y + 1 < f.height; ++y)
    for (int x = 0; x + 1 < f.width; ++x)
      if (std::isfinite(f.at(x, y)) && std::isfinite(f.at(x + 1, y)) && std::isfinite(f.at(x, y + 1)) &&
          std::isfinite(f.at(x + 1, y + 1)))
        return true;
  return false;
}

}  // namespace

void declare_options(Options& o, ContourOptions& c) {
  o.section("Lines of equal value");
  o.text("contours", c.of, "NAME",
         "draw lines of equal value with labels: of the layer NAME of an image, such as illuminance; or of "
         "the column NAME of a table of sensors on a horizontal grid, such as E_lx, seen from above");
  o.list("levels", c.levels, "X",
         "values of the lines, in the unit of the layer or column (default: round numbers)");
  o.number("spacing", c.spacing_m, "METRES",
           "required with --contours of a table: distance between neighbours on the grid", kPositive);
}

std::string given_contour_option(const Options& options) {
  return options.first_given({"contours", "levels", "spacing"});
}

void check_usage(const ContourOptions& c, bool table) {
  const auto refuse = [](const char* option, const char* why) { throw Error(ExitCode::usage, option, why); };
  if (c.of.empty()) {
    if (!c.levels.empty()) refuse("--levels", "needs lines of equal value; give --contours NAME too");
    if (c.spacing_m) refuse("--spacing", "needs lines of equal value; give --contours NAME too");
    return;
  }
  numbers_of(c.levels);
  if (table && !c.spacing_m)
    refuse("--spacing", "give the distance between neighbours on the table's grid, in metres");
  if (!table && c.spacing_m) refuse("--spacing", "is for tables; an image has a value at each pixel");
}

ContourOptions fixed_levels(const Image& image, const ContourOptions& c) {
  ContourOptions fixed = c;
  if (!c.levels.empty()) return fixed;
  const std::vector<float> values = layer_values(image, layer_from_label(c.of));
  if (std::none_of(values.begin(), values.end(), [](float v) { return std::isfinite(v) && v > 0; }))
    return fixed;
  for (const double level : round_levels(false_colour_range(values, Scale::linear, 0, {}).hi))
    fixed.levels.push_back(shortest(level));
  return fixed;
}

ContouredPicture contoured(const Image& image, const Picture& picture, const ContourOptions& c) {
  const std::string layer = layer_from_label(c.of);
  const std::vector<float> values = layer_values(image, layer);
  const std::string unit = layer_unit(layer);
  return contours_over(picture, {image.width(), image.height(), {values.begin(), values.end()}},
                       numbers_of(fixed_levels(image, c).levels), unit == "1" ? "" : unit);
}

TableContours contours_of(const CsvTable& table, const ContourOptions& c) {
  const std::size_t x = table.column("x", "--contours"), z = table.column("z", "--contours"),
                    value = table.column(c.of, "--contours");
  PHOS_CHECK(c.spacing_m, "checked by check_usage()");
  const double spacing = *c.spacing_m;
  const auto fail = [&](const std::string& what) { throw Error(ExitCode::bad_input, table.where, what); };
  Ticks xs, zs;
  double most = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    xs.add(table.number(i, x)), zs.add(table.number(i, z));
    if (const double v = table.number(i, value); std::isfinite(v)) most = std::max(most, v);
  }
  if (!std::isfinite(xs.last - xs.first) || !std::isfinite(zs.last - zs.first))
    fail("no row has finite places x and z");
  const double columns = xs.count(spacing), rows = zs.count(spacing);
  if (!(columns * rows <= kMostPlaces))
    fail(text("has a grid of ", columns, " x ", rows, " places at a --spacing of ", spacing,
              " m; give the distance between neighbours"));
  TableContours out;
  GridField& field = out.plan.field;
  field.width = static_cast<int>(columns), field.height = static_cast<int>(rows);
  field.values.assign(static_cast<std::size_t>(columns * rows), std::numeric_limits<double>::quiet_NaN());
  std::vector<bool> taken(field.values.size(), false);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double px = table.number(i, x), pz = table.number(i, z);
    if (!std::isfinite(px) || !std::isfinite(pz)) continue;
    const std::size_t at =
        static_cast<std::size_t>(zs.index(pz, spacing)) * static_cast<std::size_t>(field.width) +
        static_cast<std::size_t>(xs.index(px, spacing));
    out.hidden += taken[at] ? 1 : 0;
    taken[at] = true, field.values[at] = table.number(i, value);
  }
  if (!has_cell(field))
    fail(text("no four sensors are neighbours at a --spacing of ", spacing,
              " m in x and z; give the distance between neighbours on a horizontal grid"));
  out.plan.x0_m = xs.first, out.plan.z0_m = zs.first, out.plan.spacing_m = spacing;
  out.plan.unit = c.of.ends_with("_lx") ? "lx" : "";
  out.plan.levels = c.levels.empty() ? round_levels(most) : numbers_of(c.levels);
  return out;
}

}  // namespace phos::inline image
