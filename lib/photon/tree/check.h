// Checks that a saved kd-tree is a tree over these points. FLANN trusts the bytes that it loads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/vector.h"

namespace phos::inline photon {

/// What FLANN's header says of the stream behind it.
struct TreeStream {
  std::span<const std::byte> bytes;  ///< header and blocks
  std::size_t header_bytes = 0;
  std::uint64_t first_block = 0;  ///< length of the first block
};

/// FLANN halves either the points or their extent along an axis: 31 times the one, 3 x 211 times the other
/// (from 2e18 m to the least float), is as deep as it can get.
inline constexpr std::size_t kDeepestTree = 1024;

/// Passes if FLANN can load the stream, and finds exactly the neighbours with it: every point is in one leaf,
/// the leaves follow each other, no point lies beyond the planes and the box above it, and the tree is not
/// too deep to be walked. Takes one pass over the points, and no memory but a bit a point. Throws
/// FlannStream::Damaged, whose text goes on from "the kd-tree ". `points` must be finite, at most 2^31-1.
void check_tree(std::span<const Vec3> points, const TreeStream& stream);

}  // namespace phos::inline photon
