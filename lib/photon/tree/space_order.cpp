#include "photon/tree/space_order.h"

#include <cstddef>

#include "core/parallel.h"

namespace phos::inline photon {
namespace {

constexpr std::size_t kChunk = 1 << 16;
constexpr int kBits = 21;  // of each axis: three fill a word

/// Two zeros before each of the lowest 21 bits, by halving the groups that are already apart.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffff;
  x = (x | x << 16) & 0x001f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

Bounds bounds_of(std::span<const Vec3> points) {
  return parallel_reduce<Bounds>(
      points.size(), kChunk, {},
      [&](std::size_t begin, std::size_t end) {
        Bounds part;
        for (std::size_t i = begin; i < end; ++i) part.include(points[i]);
        return part;
      },
      [](Bounds& total, const Bounds& part) { total.include(part.lo), total.include(part.hi); });
}

}  // namespace

std::uint64_t SpaceCubes::operator()(const Vec3& point) const {
  const auto cell = [&](float x_m, float lowest_m) {
    const double part = side_m_ > 0 ? (double{x_m} - double{lowest_m}) / side_m_ : 0;
    return spread(static_cast<std::uint64_t>(part * ((1 << kBits) - 1)));
  };
  return cell(point.x, lo_.x) << 2 | cell(point.y, lo_.y) << 1 | cell(point.z, lo_.z);
}

Column<std::uint32_t> space_order(std::span<const Vec3> points) {
  const SpaceCubes cube(bounds_of(points));
  Column<CubeRow> rows(points.size());
  parallel_for(rows.size(), kChunk, [&](std::size_t i) {
    rows[i] = {cube(points[i]), static_cast<std::uint32_t>(i)};
  });
  parallel_sort(rows, kChunk);
  Column<std::uint32_t> order(rows.size());
  parallel_for(order.size(), kChunk, [&](std::size_t i) { order[i] = rows[i].row; });
  return order;
}

}  // namespace phos::inline photon
