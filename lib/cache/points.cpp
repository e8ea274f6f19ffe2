// Points from text: CSV with named columns, or six numbers a line.
#include <array>
#include <charconv>
#include <iostream>
#include <istream>
#include <iterator>

#include "cache/placement.h"
#include "cache/sensors.h"
#include "core/error.h"
#include "file/atomic_file.h"

namespace phos {
namespace {

constexpr float kFarthest = 1e18f;  // the ray tracer takes no coordinates beyond
constexpr std::size_t kId = 6, kColumns = 7, kAbsent = ~std::size_t{0};
constexpr const char* kNames[kColumns] = {"x", "y", "z", "nx", "ny", "nz", "id"};
constexpr const char* kHint = "the first line must name the columns x,y,z,nx,ny,nz, or hold six numbers";

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r')) s.remove_suffix(1);
  return s;
}

/// "x [m]" and "x_m" are x.
std::string_view without_unit(std::string_view name) {
  name = trimmed(name.substr(0, name.find('[')));
  return name.ends_with("_m") ? name.substr(0, name.size() - 2) : name;
}

bool read_number(std::string_view s, float& v) {
  if (!s.empty() && s.front() == '+') s.remove_prefix(1);
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), v);
  return error == std::errc() && end == s.data() + s.size() && std::isfinite(v);
}

class Reader {
 public:
  Reader(const std::string& where, Sensors& sensors) : where_(where), sensors_(sensors) {}

  void line(std::string_view row, std::size_t number) {
    number_ = number;
    if (number == 1 && row.starts_with("\xef\xbb\xbf")) row.remove_prefix(3);
    row = trimmed(row);
    if (row.empty() || row.front() == '#') return;
    if (!started_) {
      commas_ = row.find(',') != std::string_view::npos;
      started_ = true;
      split(row);
      if (name_columns()) return;
    } else {
      split(row);
    }
    add();
  }

  bool started() const { return started_; }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ExitCode::bad_input, where_, text("line ", number_, what));
  }

  /// Into cells_, between commas or blanks. Quoted ones hold anything but line breaks; "" is a quote there.
  void split(std::string_view row) {
    cells_.clear();
    unquoted_.clear();
    unquoted_.reserve(row.size());  // views of it stay valid
    if (!commas_) {
      for (std::size_t at = 0; at < row.size();) {
        const std::size_t end = std::min(row.find_first_of(" \t", at), row.size());
        if (end > at) cells_.push_back(row.substr(at, end - at));
        at = end + 1;
      }
      return;
    }
    for (;;) {
      while (!row.empty() && (row.front() == ' ' || row.front() == '\t')) row.remove_prefix(1);
      const bool quoted = !row.empty() && row.front() == '"';
      const std::size_t length = quoted ? quoted_cell(row) : std::min(row.find(','), row.size());
      if (!quoted) cells_.push_back(trimmed(row.substr(0, length)));
      row.remove_prefix(length);
      if (row.empty()) return;
      row.remove_prefix(1);
    }
  }

  /// Adds the cell; returns how many characters it takes up to the next comma.
  std::size_t quoted_cell(std::string_view row) {
    const std::size_t first = unquoted_.size();
    std::size_t at = 1;
    for (;; ++at) {
      if (at >= row.size()) refuse(text(": column ", cells_.size() + 1, " has a quote that does not end"));
      if (row[at] == '"' && (at + 1 >= row.size() || row[at + 1] != '"')) break;
      if (row[at] == '"') ++at;
      unquoted_ += row[at];
    }
    cells_.push_back(std::string_view(unquoted_).substr(first));
    const std::size_t comma = std::min(row.find(',', at), row.size());
    if (!trimmed(row.substr(at + 1, comma - at - 1)).empty())
      refuse(text(": column ", cells_.size(), " goes on after its quote"));
    return comma;
  }

  /// False if the first line is one of numbers.
  bool name_columns() {
    float v;
    if (cells_.size() == 6 && read_number(cells_[0], v)) {
      for (std::size_t i = 0; i < 6; ++i) column_[i] = i;
      exact_ = true;
      return false;
    }
    column_.fill(kAbsent);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      for (std::size_t k = 0; k < kColumns; ++k) {
        if (without_unit(cells_[i]) != kNames[k]) continue;
        if (column_[k] != kAbsent) refuse(text(" names column ", kNames[k], " twice"));
        column_[k] = i;
      }
    }
    for (std::size_t k = 0; k < kId; ++k) {
      if (column_[k] == kAbsent)
        throw Error(ExitCode::bad_input, where_, text("no column ", kNames[k], "; ", kHint));
    }
    return true;
  }

  void add() {
    float v[6];
    if (exact_ && cells_.size() != 6) refuse(text(" has ", cells_.size(), " columns; give six numbers"));
    for (std::size_t k = 0; k < kColumns; ++k) {
      if (column_[k] != kAbsent && column_[k] >= cells_.size())
        refuse(text(" has only ", cells_.size(), " columns; column ", kNames[k], " is missing"));
      if (k < kId && !read_number(cells_[column_[k]], v[k]))
        refuse(text(": column ", kNames[k], " is not a finite number"));
      if (k < 3 && std::fabs(v[k]) > kFarthest)
        refuse(text(": column ", kNames[k], " is farther off than 1e18 m"));
    }
    const Vec3 normal = normalized_or_zero({v[3], v[4], v[5]});
    if (normal == Vec3(0)) refuse(": columns nx,ny,nz: the normal is zero");
    sensors_.points.push_back({{v[0], v[1], v[2]}, normal});
    if (column_[kId] != kAbsent) sensors_.ids.emplace_back(cells_[column_[kId]]);
  }

  const std::string& where_;
  Sensors& sensors_;
  std::size_t number_ = 0;
  bool started_ = false, commas_ = true, exact_ = false;
  std::array<std::size_t, kColumns> column_{kAbsent, kAbsent, kAbsent, kAbsent, kAbsent, kAbsent, kAbsent};
  std::vector<std::string_view> cells_;
  std::string unquoted_;
};

}  // namespace

Sensors parse_sensors(std::string_view text, const std::string& where) {
  Sensors sensors;
  Reader reader(where, sensors);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    reader.line(text.substr(0, end), number);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (!reader.started()) throw Error(ExitCode::bad_input, where, std::string("is empty; ") + kHint);
  return sensors;
}

Sensors read_sensors(const std::string& path) {
  if (path != "-") return parse_sensors(read_text(path), path);
  const std::string all{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
  return parse_sensors(all, "stdin");
}

std::vector<SurfaceSample> read_points(const std::string& path) {
  return parse_sensors(read_text(path), path).points;
}

}  // namespace phos
