#include "scene/spectral/join_readings.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/json.h"
#include "core/parallel.h"
#include "file/atomic_file.h"
#include "file/csv.h"
#include "scene/spectral/colour_rendering.h"
#include "scene/spectral/join_parts.h"

namespace phos::inline scene {
namespace {

constexpr const char* kPlace[] = {"id", "x", "y", "z", "nx", "ny", "nz"};
constexpr const char* kStandardError = "stderr_lx";
constexpr const char* kSums[] = {"E_lx", kStandardError, "direct_lx", "indirect_lx"};
constexpr std::size_t kSumCount = std::size(kSums);

/// K and N of "band_K_of_N_lx".
std::optional<std::pair<int, int>> band_column(std::string_view name) {
  const auto take = [&](std::string_view word) {
    if (!name.starts_with(word)) return false;
    name.remove_prefix(word.size());
    return true;
  };
  const auto number = [&](int& n) {
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), n);
    if (error != std::errc()) return false;
    name.remove_prefix(static_cast<std::size_t>(end - name.data()));
    return n >= 1 && n <= Bands::kMost;
  };
  int band = 0, of = 0;
  if (!take("band_") || !number(band) || !take("_of_") || !number(of) || name != "_lx" || band > of)
    return {};
  return std::pair{band, of};
}

std::size_t column_of(const CsvTable& table, const std::string& name) {
  const auto at = std::find(table.columns.begin(), table.columns.end(), name);
  if (at == table.columns.end())
    throw Error(ExitCode::bad_input, table.where,
                text("has no column ", name, "; give tables of phos-sense"));
  return static_cast<std::size_t>(at - table.columns.begin());
}

/// A standard error may be left out: it is then not a number.
double number_in(const CsvTable& table, std::size_t row, std::size_t column) {
  const double v = table.number(row, column);
  const bool left_out = table.columns[column] == kStandardError && table.rows[row][column].empty();
  if (!std::isfinite(v) && !left_out)
    throw Error(ExitCode::bad_input, table.where,
                text("line ", table.line[row], ": ", table.columns[column],
                     " is not a number; give the table as phos-sense wrote it"));
  return v;
}

/// Sums over the triplets, of every sensor.
struct Sums {
  std::vector<std::array<double, kSumCount>> of_all;
  std::vector<std::vector<double>> of_bands;

  Sums(std::size_t sensors, int bands)
      : of_all(sensors), of_bands(sensors, std::vector<double>(static_cast<std::size_t>(bands), 0.0)) {}

  void add(const CsvTable& table) {
    for (std::size_t k = 0; k < kSumCount; ++k) {
      const std::size_t column = column_of(table, kSums[k]);
      for (std::size_t row = 0; row < of_all.size(); ++row) of_all[row][k] += number_in(table, row, column);
    }
    for (std::size_t column = 0; column < table.columns.size(); ++column)
      if (const auto band = band_column(table.columns[column]))
        for (std::size_t row = 0; row < of_bands.size(); ++row)
          of_bands[row][static_cast<std::size_t>(band->first - 1)] = number_in(table, row, column);
  }
};

void require_same_sensors(const CsvTable& a, const CsvTable& b) {
  if (a.rows.size() != b.rows.size())
    throw Error(ExitCode::mismatch, b.where,
                text("has ", b.rows.size(), " sensors, ", a.where, " has ", a.rows.size(),
                     "; give tables of the same sensors"));
  for (const char* name : kPlace) {
    const std::size_t of_a = column_of(a, name), of_b = column_of(b, name);
    for (std::size_t row = 0; row < a.rows.size(); ++row)
      if (a.rows[row][of_a] != b.rows[row][of_b])
        throw Error(ExitCode::mismatch, b.where,
                    text("line ", b.line[row], ": has another ", name, " than ", a.where,
                         "; give tables of the same sensors"));
  }
}

std::string line_of(const CsvTable& places, std::size_t row, const Sums& sums, const Bands& bands,
                    const WavelengthSteps& steps) {
  std::string out;
  bool first = true;
  const auto put = [&](const std::string& cell) {
    if (!first) out += ',';
    out += cell, first = false;
  };
  const auto put_number = [&](double v) {
    put(std::isnan(v) ? std::string() : shortest(static_cast<float>(v)));
  };
  for (const char* name : kPlace) put(csv_cell(places.rows[row][column_of(places, name)]));
  for (const double v : sums.of_all[row]) put_number(v);
  DVec3 xyz(0);
  std::vector<double> power;
  for (int b = 0; b < bands.size(); ++b) {
    const double lx = sums.of_bands[row][static_cast<std::size_t>(b)];
    xyz += lx / bands.white_xyz(b).y * bands.white_xyz(b);
    power.push_back(lx / bands.matching(b).y);
  }
  for (int c = 0; c < 3; ++c) put_number(xyz[c]);
  if (const auto colour = colour_rendering(steps, power))
    put_number(colour->cct_K), put_number(colour->duv), put_number(colour->ra);
  else
    out += ",,,";
  for (const double lx : sums.of_bands[row]) put_number(lx);
  out += '\n';
  return out;
}

}  // namespace

std::optional<BandTriplet> triplet_of(const CsvTable& table) {
  std::optional<BandTriplet> out;
  for (const std::string& name : table.columns)
    if (const auto band = band_column(name); band && !out)
      out = BandTriplet{band->second, (band->first + 2) / 3};
  return out;
}

std::string join_readings(const BandParts& parts) {
  std::vector<CsvTable> tables;
  for (const std::string& path : parts.paths) tables.push_back(parse_csv(read_text(path), path));
  std::vector<BandTriplet> triplets;
  for (const CsvTable& table : tables) {
    const std::optional<BandTriplet> t = triplet_of(table);
    if (!t || t->number < Bands::kLeast)
      throw Error(ExitCode::bad_input, table.where,
                  "has no bands; give tables that phos-sense wrote with --bands and --triplet");
    for (const std::string& name : table.columns)
      if (const auto band = band_column(name);
          band && (band->second != t->number || (band->first + 2) / 3 != t->triplet))
        throw Error(ExitCode::bad_input, table.where,
                    "has bands of more than one triplet; give tables of phos-sense, not joined ones");
    for (int c = 0; c < 3; ++c)
      if (const int band = 3 * (t->triplet - 1) + c + 1; band <= t->number)
        column_of(table, text("band_", band, "_of_", t->number, "_lx"));
    triplets.push_back(*t);
  }
  order_of(parts, [&](std::size_t i) { return triplets[i]; });

  const Bands bands(triplets[0].number);
  const WavelengthSteps steps(bands);
  Sums sums(tables[0].rows.size(), bands.size());
  for (const CsvTable& table : tables) {
    require_same_sensors(tables[0], table);
    sums.add(table);
  }
  std::string out = "id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx,X_lx,Y_lx,Z_lx,CCT_K,Duv,Ra";
  for (int b = 1; b <= bands.size(); ++b) out += text(",band_", b, "_of_", bands.size(), "_lx");
  out += '\n';
  std::vector<std::string> lines(tables[0].rows.size());
  parallel_for(lines.size(), 1,
               [&](std::size_t row) { lines[row] = line_of(tables[0], row, sums, bands, steps); });
  for (const std::string& line : lines) out += line;
  return out;
}

}  // namespace phos::inline scene
