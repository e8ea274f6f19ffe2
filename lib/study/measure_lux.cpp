#include "study/measure_lux.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "file/atomic_file.h"
#include "file/csv.h"
#include "study/measure.h"

namespace phos::inline study {

LuxTable read_lux(const std::string& path) {
  const CsvTable csv = parse_csv(read_text(path), path);
  const auto find = [&](std::initializer_list<const char*> names) {
    for (const char* name : names)
      for (std::size_t i = 0; i < csv.columns.size(); ++i)
        if (csv.columns[i] == name) return i;
    return csv.columns.size();
  };
  const std::size_t x = find({"x"}), y = find({"y"}), z = find({"z"}), lux = find({"E_lx", "illuminance_lx"}),
                    spread = find({"stderr_lx"}), none = csv.columns.size();
  if (x == none || y == none || z == none || lux == none)
    throw Error(ExitCode::bad_input, path,
                text("is not a table of lux: it has the columns ", csv.names(),
                     "; give one of phos-sense or phos-reference --points"));
  if (csv.rows.empty()) throw Error(ExitCode::bad_input, path, "has no sensor; give points");
  LuxTable table;
  table.where = path;
  const auto cell = [&](std::size_t row, std::size_t column) {
    return static_cast<float>(csv.number(row, column));
  };
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    table.position.push_back({cell(i, x), cell(i, y), cell(i, z)});
    table.lux.push_back(cell(i, lux));
    if (spread != none) table.stderr_lx.push_back(cell(i, spread));
  }
  // Errors that are not stated everywhere say nothing of the whole.
  if (std::any_of(table.stderr_lx.begin(), table.stderr_lx.end(), [](float s) { return std::isnan(s); }))
    table.stderr_lx.clear();
  return table;
}

namespace {

void require_same_sensors(const LuxTable& table, const LuxTable& reference) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::mismatch, table.where,
                text(why, " in ", reference.where, "; measure both at the same points"));
  };
  if (table.position.size() != reference.position.size())
    refuse(text("has ", table.position.size(), " sensors, and there are ", reference.position.size()));
  for (std::size_t i = 0; i < table.position.size(); ++i)
    if (table.position[i] != reference.position[i])
      refuse(text("its sensor ", i, " is not where that sensor is"));
}

/// A row of pixels.
Image as_image(const LuxTable& table) {
  Image image(static_cast<int>(table.lux.size()), 1);
  std::copy(table.lux.begin(), table.lux.end(), image.channel("illuminance.Y").begin());
  if (!table.stderr_lx.empty())
    std::copy(table.stderr_lx.begin(), table.stderr_lx.end(), image.channel("illuminance_stderr.Y").begin());
  return image;
}

}  // namespace

MeasuredError measure_lux(const LuxTable& table, const LuxTable& reference, const LuxTable* second) {
  require_same_sensors(table, reference);
  if (second) require_same_sensors(*second, reference);
  const Image other = second ? as_image(*second) : Image();
  MeasuredError error = measure_picture(as_image(table), as_image(reference), second ? &other : nullptr,
                                        {"illuminance", false});
  error.quantity = "lux";
  return error;
}

}  // namespace phos::inline study
