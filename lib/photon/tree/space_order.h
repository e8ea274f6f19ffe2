// An order of points in which neighbours in space are neighbours in memory.
#pragma once

#include <cstdint>
#include <span>

#include "core/column.h"
#include "core/vector.h"

namespace phos::inline photon {

/// Rows of `points` (finite, at most 2^32) along Morton's curve (1966) through cubes of the 2^-21 part of the
/// longest side of their bounds; points of one cube by row. Does not depend on scale or offset but by
/// rounding.
Column<std::uint32_t> space_order(std::span<const Vec3> points);

}  // namespace phos::inline photon
