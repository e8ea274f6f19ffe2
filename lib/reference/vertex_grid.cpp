#include "reference/vertex_grid.h"

#include <bit>
#include <cmath>

namespace phos::inline reference {

VertexGrid::VertexGrid(std::span<const LightVertex> vertices, float radius_m)
    : vertices_(vertices), radius_m_(radius_m), per_cell_(0.5 / static_cast<double>(radius_m)) {
  std::size_t n = 0;
  for (const LightVertex& v : vertices) n += v.after_sharp;
  if (n == 0 || !(radius_m > 0)) return;
  first_.assign(std::bit_ceil(2 * n) + 1, 0);
  index_.resize(n);
  const auto key = [&](const LightVertex& v) {
    const Vec3& p = v.point.position;
    return hash(cell(p.x), cell(p.y), cell(p.z));
  };
  for (const LightVertex& v : vertices)
    if (v.after_sharp) ++first_[key(v) + 1];
  for (std::size_t h = 1; h < first_.size(); ++h) first_[h] += first_[h - 1];
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (vertices[i].after_sharp) index_[next[key(vertices[i])]++] = static_cast<std::uint32_t>(i);
}

std::int64_t VertexGrid::cell(float x) const {
  constexpr double kMost = 0x1p60;
  const double c = std::floor(static_cast<double>(x) * per_cell_);
  return std::fabs(c) < kMost ? static_cast<std::int64_t>(c) : 0;
}

std::uint64_t VertexGrid::hash(std::int64_t x, std::int64_t y, std::int64_t z) const {
  // Multipliers of Teschner et al. 2003; the end of SplitMix64 spreads their low bits.
  std::uint64_t h = static_cast<std::uint64_t>(x) * 73856093u ^ static_cast<std::uint64_t>(y) * 19349663u ^
                    static_cast<std::uint64_t>(z) * 83492791u;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
  return (h ^ (h >> 31)) & (first_.size() - 2);
}

}  // namespace phos::inline reference
