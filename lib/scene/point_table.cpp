#include "scene/point_table.h"

#include <array>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "file/csv.h"

namespace phos::inline scene {
namespace {

constexpr float kFarthest = 1e18f;  // the ray tracer takes no coordinates beyond
constexpr std::size_t kId = 6, kColumns = 7, kAbsent = ~std::size_t{0};
constexpr const char* kNames[kColumns] = {"x", "y", "z", "nx", "ny", "nz", "id"};
constexpr const char* kHint = "the first line must name the columns x,y,z,nx,ny,nz, or hold six numbers";

/// "x [m]" and "x_m" are x.
std::string_view without_unit(std::string_view name) {
  name = name.substr(0, name.find('['));
  while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
  return name.ends_with("_m") ? name.substr(0, name.size() - 2) : name;
}

bool read_number(std::string_view s, float& v) {
  if (!s.empty() && s.front() == '+') s.remove_prefix(1);
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), v);
  return error == std::errc() && end == s.data() + s.size() && std::isfinite(v);
}

class Rows {
 public:
  Rows(std::string_view text, const std::string& where, const DVec3& origin_m, PointTable& table)
      : reader_(text, where, CsvGap::by_line), where_(where), origin_m_(origin_m), table_(table) {}

  void read() {
    if (!reader_.next(cells_)) throw Error(ExitCode::bad_input, where_, std::string("is empty; ") + kHint);
    if (!name_columns()) add();
    while (reader_.next(cells_)) add();
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ExitCode::bad_input, reader_.where(), what);
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
        if (column_[k] != kAbsent) refuse(text("names column ", kNames[k], " twice"));
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
    if (exact_ && cells_.size() != 6) refuse(text("has ", cells_.size(), " columns; give six numbers"));
    for (std::size_t k = 0; k < kColumns; ++k) {
      if (column_[k] != kAbsent && column_[k] >= cells_.size())
        refuse(text("has only ", cells_.size(), " columns; column ", kNames[k], " is missing"));
      if (k < kId && !read_number(cells_[column_[k]], v[k]))
        refuse(text("column ", kNames[k], " is not a finite number"));
      if (k < 3 && std::fabs(v[k]) > kFarthest)
        refuse(text("column ", kNames[k], " is farther off than 1e18 m"));
    }
    const Vec3 normal = normalized_or_zero({v[3], v[4], v[5]});
    if (normal == Vec3(0)) refuse("columns nx,ny,nz: the normal is zero");
    table_.position.push_back(place(v)), table_.normal.push_back(normal);
    if (column_[kId] != kAbsent) table_.id.emplace_back(cells_[column_[kId]]);
  }

  /// Floats as they are; in double where digits that a float has not would be lost.
  Vec3 place(const float* v) const {
    Vec3 p(v[0], v[1], v[2]);
    for (int c = 0; c < 3; ++c) {
      if (origin_m_[c] == 0) continue;
      double world = static_cast<double>(p[c]);
      std::string_view s = cells_[column_[static_cast<std::size_t>(c)]];
      if (!s.empty() && s.front() == '+') s.remove_prefix(1);
      std::from_chars(s.data(), s.data() + s.size(), world);
      p[c] = static_cast<float>(world - origin_m_[c]);
    }
    return p;
  }

  CsvReader reader_;
  const std::string& where_;
  DVec3 origin_m_;
  PointTable& table_;
  bool exact_ = false;
  std::array<std::size_t, kColumns> column_{kAbsent, kAbsent, kAbsent, kAbsent, kAbsent, kAbsent, kAbsent};
  std::vector<std::string> cells_;
};

}  // namespace

PointTable parse_points(std::string_view text, const std::string& where, const DVec3& origin_m) {
  PointTable table;
  Rows(text, where, origin_m, table).read();
  return table;
}

}  // namespace phos::inline scene
