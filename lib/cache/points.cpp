#include <charconv>
#include <string_view>

#include "cache/placement.h"
#include "core/error.h"
#include "file/atomic_file.h"

namespace phos {
namespace {

constexpr const char* kColumns[6] = {"x", "y", "z", "nx", "ny", "nz"};

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t' || s.front() == '"')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r' || s.back() == '"'))
    s.remove_suffix(1);
  return s;
}

std::vector<std::string_view> fields(std::string_view line) {
  std::vector<std::string_view> out;
  for (;;) {
    const std::size_t comma = line.find(',');
    out.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return out;
    line.remove_prefix(comma + 1);
  }
}

/// "x [m]" and "x_m" are x.
std::string_view without_unit(std::string_view name) {
  name = trimmed(name.substr(0, name.find('[')));
  return name.ends_with("_m") ? name.substr(0, name.size() - 2) : name;
}

std::vector<std::size_t> find_columns(const std::vector<std::string_view>& header, const std::string& path) {
  std::vector<std::size_t> columns;
  for (const char* wanted : kColumns) {
    std::size_t i = 0;
    while (i < header.size() && without_unit(header[i]) != wanted) ++i;
    if (i == header.size()) {
      throw Error(ExitCode::bad_input, path,
                  text("no column ", wanted, "; the first line must name the columns x,y,z,nx,ny,nz"));
    }
    columns.push_back(i);
  }
  return columns;
}

float number(std::string_view s, const std::string& path, std::size_t line, const char* column) {
  float v = 0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), v);
  if (error != std::errc() || end != s.data() + s.size() || !std::isfinite(v)) {
    throw Error(ExitCode::bad_input, path,
                text("line ", line, ": column ", column, " is not a finite number"));
  }
  return v;
}

}  // namespace

std::vector<SurfaceSample> read_points(const std::string& path) {
  const std::string content = read_text(path);
  std::vector<SurfaceSample> points;
  std::vector<std::size_t> columns;
  std::string_view rest = content;
  for (std::size_t line = 1; !rest.empty(); ++line) {
    const std::size_t end = rest.find('\n');
    const std::string_view row = trimmed(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (row.empty() || row.front() == '#') continue;
    const auto cells = fields(row);
    if (columns.empty()) {
      columns = find_columns(cells, path);
      continue;
    }
    float v[6];
    for (std::size_t i = 0; i < 6; ++i) {
      if (columns[i] >= cells.size()) {
        throw Error(ExitCode::bad_input, path, text("line ", line, " has only ", cells.size(), " columns"));
      }
      v[i] = number(cells[columns[i]], path, line, kColumns[i]);
    }
    const Vec3 normal = normalized_or_zero({v[3], v[4], v[5]});
    if (normal == Vec3(0))
      throw Error(ExitCode::bad_input, path, text("line ", line, ": the normal is zero"));
    points.push_back({{v[0], v[1], v[2]}, normal});
  }
  if (columns.empty())
    throw Error(ExitCode::bad_input, path, "is empty; the first line must name x,y,z,nx,ny,nz");
  return points;
}

}  // namespace phos
