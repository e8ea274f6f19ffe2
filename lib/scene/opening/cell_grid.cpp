#include "scene/opening/cell_grid.h"

#include <algorithm>
#include <array>

namespace phos::inline scene {
namespace {

constexpr float kLeastCosine = 0.05f;

}  // namespace

CellGrid::CellGrid(const Portal& rectangle, int side)
    : rectangle_(rectangle),
      side_(side),
      open_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}

bool CellGrid::any_open() const {
  return std::any_of(open_.begin(), open_.end(), [](std::uint8_t open) { return open != 0; });
}

bool CellGrid::crosses_clearly(const Vec3& direction) const {
  return -glm::dot(direction, rectangle_.inwards) > kLeastCosine;
}

std::size_t CellGrid::cell_at(const Vec3& place) const {
  const Vec3 way = place - rectangle_.corner;
  const auto along = [&](const Vec3& edge) {
    const float share = glm::dot(way, edge) / glm::dot(edge, edge);
    return static_cast<int>(
        std::clamp(share * static_cast<float>(side_), 0.f, static_cast<float>(side_ - 1)));
  };
  return index(along(rectangle_.edge[0]), along(rectangle_.edge[1]));
}

Vec3 CellGrid::place_in(std::size_t cell, const Vec2& weight) const {
  return rectangle_.at((Vec2(u_of(cell), v_of(cell)) + weight) / static_cast<float>(side_));
}

std::vector<std::size_t> CellGrid::neighbours(std::size_t cell) const {
  std::vector<std::size_t> out;
  const int u = u_of(cell), v = v_of(cell);
  for (int y = std::max(v - 1, 0); y <= std::min(v + 1, side_ - 1); ++y)
    for (int x = std::max(u - 1, 0); x <= std::min(u + 1, side_ - 1); ++x)
      if (x != u || y != v) out.push_back(index(x, y));
  return out;
}

void CellGrid::widen() {
  const std::vector<std::uint8_t> before = open_;
  for (std::size_t cell = 0; cell < before.size(); ++cell)
    if (before[cell] != 0)
      for (const std::size_t next : neighbours(cell)) open(next);
}

/// Without the rows and columns at the sides that are closed all along.
CellGrid::Cells CellGrid::trimmed(const Cells& c) const {
  Cells out{side_, side_, 0, 0};
  int end_u = 0, end_v = 0;
  for (int v = c.v; v < c.v + c.high; ++v)
    for (int u = c.u; u < c.u + c.wide; ++u) {
      if (!is_open(index(u, v))) continue;
      out.u = std::min(out.u, u), out.v = std::min(out.v, v);
      end_u = std::max(end_u, u + 1), end_v = std::max(end_v, v + 1);
    }
  out.wide = std::max(end_u - out.u, 0), out.high = std::max(end_v - out.v, 0);
  return out;
}

/// Cut in two where most closed cells fall away.
void CellGrid::cut(const Cells& all, double least_saved, std::vector<Cells>& out) const {
  if (all.count() == 0) return;
  std::array<Cells, 2> best{};
  int left = all.count();
  const auto consider = [&](const Cells& one, const Cells& other) {
    const std::array<Cells, 2> parts{trimmed(one), trimmed(other)};
    const int count = parts[0].count() + parts[1].count();
    if (count < left) best = parts, left = count;
  };
  for (int k = 1; k < all.wide; ++k)
    consider({all.u, all.v, k, all.high}, {all.u + k, all.v, all.wide - k, all.high});
  for (int k = 1; k < all.high; ++k)
    consider({all.u, all.v, all.wide, k}, {all.u, all.v + k, all.wide, all.high - k});
  if (left > (1 - least_saved) * all.count()) return out.push_back(all);
  for (const Cells& part : best) cut(part, least_saved, out);
}

std::vector<Portal> CellGrid::open_rectangles(double least_saved) const {
  std::vector<Cells> parts;
  cut(trimmed({0, 0, side_, side_}), least_saved, parts);
  std::vector<Portal> out;
  for (const Cells& c : parts) {
    const auto part = [&](int cells) { return static_cast<float>(cells) / static_cast<float>(side_); };
    Portal p = rectangle_;
    p.corner = rectangle_.at(Vec2(part(c.u), part(c.v)));
    p.edge[0] *= part(c.wide), p.edge[1] *= part(c.high);
    out.push_back(p);
  }
  return out;
}

}  // namespace phos::inline scene
