// A kd-tree over points by FLANN's rule, built by all threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/column.h"
#include "core/vector.h"
#include "photon/tree/split.h"

namespace phos::inline photon {

/// The positions of the parts that FLANN saves of a KDTreeSingleIndex over n points, behind its header:
/// members and box, the order of the points (4 bytes each), the nodes depth first (five values of 4 bytes and
/// one of 1).
inline constexpr std::size_t kTreeOrder = 95, kTreeNode = 21, kTreeBox = 63;

/// The nodes over some points of a tree, as saved, depth first; the first of the points is number `begin` of
/// the tree's order, in which the points are put. `box` holds them all, and is the one about them afterwards.
Column<std::byte> build_nodes(std::span<TreePoint> points, std::size_t begin, int leaf_size, Bounds& box);

/// A node over two others; `first` and `second` are their boxes.
std::array<std::byte, kTreeNode> saved_node(int axis, const Bounds& first, const Bounds& second);

/// What stands before the order: sizes and the box about all points.
std::array<std::byte, kTreeOrder> saved_index(std::uint64_t points, int leaf_size, const Bounds& box);

/// The same bytes as FLANN's own builder, which runs on one thread, saves behind its header: the planes, the
/// points in the leaves and their order are as in KDTreeSingleIndex::buildIndex (midpoint of the widest
/// side, moved to where there are points) with this leaf size and without reordering. `points` (1 to 2^31-1)
/// must be finite and so near 0 that squares of distances are finite.
Column<std::byte> build_tree(std::span<const Vec3> points, int leaf_size);

}  // namespace phos::inline photon
