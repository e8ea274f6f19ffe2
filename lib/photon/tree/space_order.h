// An order of points in which neighbours in space are neighbours in memory.
#pragma once

#include <compare>
#include <cstdint>
#include <span>

#include "core/column.h"
#include "core/vector.h"

namespace phos::inline photon {

/// A row and its cube of Morton's curve. Rows in space order are sorted by it.
struct CubeRow {
  std::uint64_t cube;
  std::uint32_t row;
  auto operator<=>(const CubeRow&) const = default;
};

/// Numbers of the cubes of a space order.
class SpaceCubes {
 public:
  /// `bounds` of all points; not empty where a point is asked for.
  explicit SpaceCubes(const Bounds& bounds) : lo_(bounds.lo), side_m_(max_component(bounds.size())) {}
  std::uint64_t operator()(const Vec3& point) const;

 private:
  Vec3 lo_;
  double side_m_;
};

/// Rows of `points` (finite, at most 2^32) along Morton's curve (1966) through cubes of the 2^-21 part of the
/// longest side of their bounds; points of one cube by row. Does not depend on scale or offset but by
/// rounding.
Column<std::uint32_t> space_order(std::span<const Vec3> points);

}  // namespace phos::inline photon
