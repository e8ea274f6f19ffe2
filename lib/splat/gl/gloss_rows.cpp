#include "splat/gl/gloss_rows.h"

#include <algorithm>

#include "hsh/basis.h"

namespace phos::inline splat {
namespace {

std::size_t column_of(int l, int m) { return static_cast<std::size_t>(l * (l + 1) / 2 + m); }

}  // namespace

GlossRows::GlossRows(const GlossTables& tables, std::size_t materials, int most)
    : tables_(tables), table_of_(materials, -1) {
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t m = 0; m < materials; ++m) {
    const BrdfTable* table = tables.table(m);
    if (table && table->isotropic && tables.least(m) == Rgb(0)) chosen.push_back(m);
  }
  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return tables.order(a) < tables.order(b); });
  int rows = 0;
  for (const std::uint32_t m : chosen) {
    const BrdfTable* table = tables.table(m);
    if (rows + table->resolution > most) break;
    table_of_[m] = static_cast<std::int32_t>(all_.size());
    all_.push_back({table, rows});
    rows += table->resolution;
    width_ = std::max(width_, table->order * (table->order + 1) / 2);
  }
  texels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(rows));
  for (const Table& t : all_) {
    const auto numbers = 3 * static_cast<std::size_t>(harmonic_count(t.table->order));
    for (std::size_t e = 0; e < t.table->entries(); ++e) {
      Vec4* row = &texels_[static_cast<std::size_t>(width_) * (static_cast<std::size_t>(t.first) + e)];
      const float* c = &t.table->coefficients[e * numbers];
      for (int l = 0; l < t.table->order; ++l)
        for (int m = 0; m <= l; ++m) {
          const float* rgb = c + 3 * harmonic_index(l, m);
          row[column_of(l, m)] = Vec4(rgb[0], rgb[1], rgb[2], 0);
        }
      row->w = t.table->orders[e];
    }
  }
}

std::pair<int, int> GlossRows::of_order(int order) const {
  std::pair<int, int> rows(0, 0);
  for (const Table& t : all_) {
    if (t.table->order != order) continue;
    if (rows.second == 0) rows.first = t.first;
    rows.second = t.first + t.table->resolution;
  }
  return rows;
}

bool GlossRows::find(const SurfacePoint& point, const Vec3& wo, Vec4& place) const {
  if (table_of_[point.material] < 0 || point.normal != point.smooth_normal) return false;
  if (!(glm::dot(wo, point.geometric_normal) > 0)) return false;
  const Table& t = all_[static_cast<std::size_t>(table_of_[point.material])];
  const Vec3 local = make_frame(point.smooth_normal).to_local(wo);
  if (!(local.z > 0) || BrdfLookup(*t.table).order(local) == 0) return false;
  // BrdfTable: row k is tan(t/2) = k / (resolution - 1).
  const Vec2 across(local.x, local.y);
  const float length = glm::length(across);
  const auto last = static_cast<float>(t.table->resolution - 1);
  const float at = std::min(length / (1 + local.z) * last, last);
  const float row = std::min(std::floor(at), last - 1);
  const Vec2 azimuth = length > 0 ? across / length : Vec2(1, 0);
  place = Vec4(static_cast<float>(t.first) + row, at - row, azimuth.x, azimuth.y);
  return true;
}

Rgb GlossRows::energy(const Vec4& place, int l) const {
  const Vec4* row = &texels_[static_cast<std::size_t>(width_) * static_cast<std::size_t>(place.x)];
  const Vec4* next = row + width_;
  Rgb sum(0);
  for (int m = 0; m <= l; ++m) {
    const Rgb c = glm::mix(Rgb(row[column_of(l, m)]), Rgb(next[column_of(l, m)]), place.y);
    sum += c * c;
  }
  return sum;
}

}  // namespace phos::inline splat
