// Light path vertices about a point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/light_path.h"

namespace phos::inline reference {

/// Hash grid over the vertices that eye paths may be merged with. Holds a reference.
class VertexGrid {
 public:
  VertexGrid() = default;
  VertexGrid(std::span<const LightVertex> vertices, float radius_m);

  float radius_m() const { return radius_m_; }
  bool empty() const { return index_.empty(); }
  /// visit(vertex, squared distance) for each one within the radius, always in the same order.
  template <class Visit>
  void about(const Vec3& p, const Visit& visit) const {
    if (empty()) return;
    // Cells are two radii wide: the ball touches two along each axis.
    std::int64_t low[3];
    for (int k = 0; k < 3; ++k) low[k] = cell(p[k] - radius_m_);
    std::uint64_t seen[8];
    int n = 0;
    for (int c = 0; c < 8; ++c) {
      const std::uint64_t h = hash(low[0] + (c & 1), low[1] + ((c >> 1) & 1), low[2] + (c >> 2));
      bool before = false;
      for (int i = 0; i < n; ++i) before = before || seen[i] == h;
      if (before) continue;
      seen[n++] = h;
      for (std::uint32_t i = first_[h]; i < first_[h + 1]; ++i) {
        const LightVertex& v = vertices_[index_[i]];
        const Vec3 way = v.point.position - p;
        const float d2 = glm::dot(way, way);
        if (d2 <= radius_m_ * radius_m_) visit(v, d2);
      }
    }
  }

 private:
  std::int64_t cell(float x) const;
  std::uint64_t hash(std::int64_t x, std::int64_t y, std::int64_t z) const;

  std::span<const LightVertex> vertices_;
  float radius_m_ = 0;
  double per_cell_ = 1;
  std::vector<std::uint32_t> first_, index_;  // of each hash, and the end; vertices by hash
};

}  // namespace phos::inline reference
