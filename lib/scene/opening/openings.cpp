#include "scene/opening/openings.h"

#include <algorithm>

#include "core/parallel.h"
#include "core/random.h"
#include "scene/sky/access.h"

namespace phos::inline scene {
namespace {

constexpr std::uint32_t kLooks = 16;       // at each cell
constexpr std::uint32_t kCloseLooks = 64;  // at each neighbour of an open cell
constexpr std::size_t kWitnesses = 4;      // kept of each cell

}  // namespace

Openings::Openings(const RayScene& rays, std::span<const Looker> lookers, const Portal& rectangle, int side,
                   std::uint64_t number)
    : rays_(rays), lookers_(lookers), grid_(rectangle, side), witness_(grid_.size()), number_(number) {}

void Openings::open(std::size_t cell, std::uint32_t looker) {
  grid_.open(cell);
  if (witness_[cell].size() < kWitnesses) witness_[cell].push_back(looker);
}

void Openings::mark(std::size_t looker, const Vec3& direction, const Vec3& place) {
  if (grid_.crosses_clearly(direction)) open(grid_.cell_at(place), static_cast<std::uint32_t>(looker));
}

/// One that sees the sky through the cell, kNobody if none does: looks are by turns of those who know it and
/// of all.
std::uint32_t Openings::find_looker(std::size_t cell, std::uint32_t looks,
                                    std::span<const std::uint32_t> knowing) const {
  RandomStream random(number_, Stage::pilot, cell);
  random.start_bounce(round_);
  for (std::uint32_t k = 0; k < looks; ++k) {
    const auto pick = [&](std::size_t n) {
      return std::min(static_cast<std::size_t>(random.uniform_double() * static_cast<double>(n)), n - 1);
    };
    const bool knows = k % 2 == 0 && !knowing.empty();
    const std::uint32_t who =
        knows ? knowing[pick(knowing.size())] : static_cast<std::uint32_t>(pick(lookers_.size()));
    const Looker& looker = lookers_[who];
    const Vec3 direction = normalized_or_zero(grid_.place_in(cell, random.uniform2()) - looker.position);
    if (glm::dot(direction, looker.normal) > 0 && grid_.crosses_clearly(direction) &&
        sees_sky(rays_, {looker.position, direction}))
      return who;
  }
  return kNobody;
}

/// Of each cell, who sees the sky through it.
std::vector<std::uint32_t> Openings::look_at(std::span<const std::size_t> cells, std::uint32_t looks,
                                             std::span<const std::span<const std::uint32_t>> knowing) {
  std::vector<std::uint32_t> found(cells.size(), kNobody);
  parallel_for(cells.size(), 16, [&](std::size_t i) { found[i] = find_looker(cells[i], looks, knowing[i]); });
  ++round_;
  return found;
}

void Openings::look(std::span<const std::uint32_t> knowing) {
  std::vector<std::size_t> closed;
  for (std::size_t cell = 0; cell < grid_.size(); ++cell)
    if (!grid_.is_open(cell)) closed.push_back(cell);
  const std::vector<std::span<const std::uint32_t>> who(closed.size(), knowing);
  const std::vector<std::uint32_t> found = look_at(closed, kLooks, who);
  for (std::size_t i = 0; i < closed.size(); ++i)
    if (found[i] != kNobody) open(closed[i], found[i]);
}

void Openings::grow() {
  std::vector<std::size_t> fresh;
  for (std::size_t cell = 0; cell < grid_.size(); ++cell)
    if (grid_.is_open(cell)) fresh.push_back(cell);
  while (!fresh.empty()) {
    std::vector<std::size_t> beside;
    for (const std::size_t cell : fresh)
      for (const std::size_t next : grid_.neighbours(cell))
        if (!grid_.is_open(next)) beside.push_back(next);
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    std::vector<std::vector<std::uint32_t>> knowing(beside.size());
    for (std::size_t i = 0; i < beside.size(); ++i)
      for (const std::size_t next : grid_.neighbours(beside[i]))
        knowing[i].insert(knowing[i].end(), witness_[next].begin(), witness_[next].end());
    const std::vector<std::uint32_t> found = look_at(
        beside, kCloseLooks, std::vector<std::span<const std::uint32_t>>(knowing.begin(), knowing.end()));
    fresh.clear();
    for (std::size_t i = 0; i < beside.size(); ++i)
      if (found[i] != kNobody) open(beside[i], found[i]), fresh.push_back(beside[i]);
  }
}

std::vector<Portal> Openings::rectangles(double least_saved) const {
  CellGrid wide = grid_;
  wide.widen();
  return wide.open_rectangles(least_saved);
}

std::vector<std::uint32_t> Openings::witnesses(const Portal& part) const {
  std::vector<std::uint32_t> out;
  const Vec3 along_first = part.edge[0] / glm::dot(part.edge[0], part.edge[0]),
             along_second = part.edge[1] / glm::dot(part.edge[1], part.edge[1]);
  for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
    if (!grid_.is_open(cell)) continue;
    const Vec3 way = grid_.place_in(cell, Vec2(0.5f)) - part.corner;
    const float u = glm::dot(way, along_first), v = glm::dot(way, along_second);
    if (u >= 0 && u <= 1 && v >= 0 && v <= 1)
      out.insert(out.end(), witness_[cell].begin(), witness_[cell].end());
  }
  return out;
}

}  // namespace phos::inline scene
