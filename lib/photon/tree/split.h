// How FLANN's kd-tree divides the points of a node in two.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/vector.h"

namespace phos::inline photon {

struct TreePoint {
  Vec3 position;
  std::int32_t row;
};

struct SplitPlane {
  int axis;
  float at;
};

struct TreeSplit {
  int axis;
  float plane;
  std::size_t first;  ///< of the points before the plane
};

/// Puts the points (2 or more) before a plane in front of those behind it, in FLANN's order. `box` holds them
/// all, but need not be tight. The plane halves the widest extent of the points; where that would leave one
/// side the larger half, points on the plane are dealt so that the halves come as near as they can.
TreeSplit split_points(std::span<TreePoint> points, const Bounds& box);
/// The same by all threads.
TreeSplit split_points_in_parallel(std::span<TreePoint> points, const Bounds& box);

/// The plane of split_points() for points in `box` with the tight box `points`.
SplitPlane split_plane(const Bounds& box, const Bounds& points);
/// Number of points on the first side, of n points: `below` lie before the plane, `not_above` before it or on
/// it.
std::size_t first_of_split(std::size_t n, std::size_t below, std::size_t not_above);

/// Swaps the first point that is not `before` with the last that is, the second with the last but one, and so
/// on; returns how many are `before`.
template <class Before>
std::size_t partition_points(std::span<TreePoint> points, const Before& before) {
  std::size_t left = 0, right = points.size();
  for (;;) {
    while (left < right && before(points[left])) ++left;
    while (left < right && !before(points[right - 1])) --right;
    if (left == right) return left;
    std::swap(points[left++], points[--right]);
  }
}

/// About one point or more. Of equal coordinates (-0 and 0) the first counts.
Bounds tight_box(std::span<const TreePoint> points);
/// The same by all threads.
Bounds tight_box_in_parallel(std::span<const TreePoint> points);
Bounds box_of_both(const Bounds& first, const Bounds& second);

}  // namespace phos::inline photon
