#include "photon/tree/build.h"

#include <algorithm>
#include <cstring>

#include "core/parallel.h"

namespace phos::inline photon {
namespace {

constexpr std::size_t kPiece = 1 << 15;   // nodes of fewer points are built by one thread each
constexpr std::size_t kShared = 1 << 18;  // nodes of more points are split by all threads together
constexpr std::size_t kCopyChunk = 1 << 16;
constexpr std::size_t kLeft = 0, kRight = 4, kAxis = 8, kLow = 12, kHigh = 16, kIsLeaf = 20;

template <class T>
void put(std::byte* at, const T& value) {
  std::memcpy(at, &value, sizeof value);
}

/// A node's box is at first about where its points may be; then about where they are.
struct Node {
  std::size_t begin, end;
  Bounds box;
  int axis = 0;
  std::size_t first = 0, second = 0;  // among the nodes at the top; 0: a piece
  std::vector<std::byte> saved{};     // a piece's nodes, depth first
};

/// A piece of the tree, by one thread.
class Piece {
 public:
  /// `origin` is the number of the first of all points in the tree's order.
  Piece(std::span<TreePoint> all, std::size_t origin, int leaf_size, std::vector<std::byte>& saved)
      : all_(all), origin_(origin), leaf_size_(static_cast<std::size_t>(leaf_size)), saved_(saved) {}

  /// `box` becomes the one about the points.
  void divide(std::size_t begin, std::size_t end, Bounds& box) {
    const std::size_t at = saved_.size();
    saved_.resize(at + kTreeNode);
    if (end - begin <= leaf_size_) {
      put(&saved_[at + kLeft], static_cast<std::int32_t>(origin_ + begin));
      put(&saved_[at + kRight], static_cast<std::int32_t>(origin_ + end));
      saved_[at + kIsLeaf] = std::byte{1};
      box = tight_box(all_.subspan(begin, end - begin));
      return;
    }
    const TreeSplit split = split_points(all_.subspan(begin, end - begin), box);
    Bounds first = box, second = box;
    first.hi[split.axis] = second.lo[split.axis] = split.plane;
    divide(begin, begin + split.first, first);
    divide(begin + split.first, end, second);
    put(&saved_[at + kAxis], split.axis);
    put(&saved_[at + kLow], first.hi[split.axis]);
    put(&saved_[at + kHigh], second.lo[split.axis]);
    box = box_of_both(first, second);
  }

 private:
  std::span<TreePoint> all_;
  std::size_t origin_, leaf_size_;
  std::vector<std::byte>& saved_;
};

TreeSplit split(std::span<TreePoint> all, const Node& node) {
  const std::span<TreePoint> own = all.subspan(node.begin, node.end - node.begin);
  return own.size() > kShared ? split_points_in_parallel(own, node.box) : split_points(own, node.box);
}

/// The nodes of more than kPiece points, level by level, and the pieces below them.
std::vector<Node> build_top(std::span<TreePoint> all, const Bounds& box) {
  std::vector<Node> nodes;
  nodes.push_back({0, all.size(), box});
  for (std::size_t level = 0, end = 1; level < end; level = end, end = nodes.size()) {
    std::vector<TreeSplit> splits(end - level);
    parallel_for(end - level, 1, [&](std::size_t k) {
      const Node& node = nodes[level + k];
      if (node.end - node.begin > kPiece) splits[k] = split(all, node);
    });
    for (std::size_t i = level; i < end; ++i) {
      const auto [axis, plane, before] = splits[i - level];
      if (nodes[i].end - nodes[i].begin <= kPiece) continue;
      Node first{nodes[i].begin, nodes[i].begin + before, nodes[i].box};
      Node second{nodes[i].begin + before, nodes[i].end, nodes[i].box};
      first.box.hi[axis] = second.box.lo[axis] = plane;
      nodes[i].axis = axis, nodes[i].first = nodes.size(), nodes[i].second = nodes.size() + 1;
      nodes.push_back(std::move(first)), nodes.push_back(std::move(second));
    }
  }
  return nodes;
}

void build_pieces(std::span<TreePoint> all, std::size_t origin, int leaf_size, std::vector<Node>& nodes) {
  parallel_for(nodes.size(), 1, [&](std::size_t i) {
    Node& node = nodes[i];
    if (node.first != 0) return;
    node.saved.reserve((node.end - node.begin) / static_cast<std::size_t>(leaf_size) * 4 * kTreeNode);
    Piece(all, origin, leaf_size, node.saved).divide(node.begin, node.end, node.box);
  });
  for (std::size_t i = nodes.size(); i-- > 0;)
    if (Node& node = nodes[i]; node.first != 0)
      node.box = box_of_both(nodes[node.first].box, nodes[node.second].box);
}

/// Where each node, or piece, is saved.
struct Places {
  std::vector<std::size_t> of_node;
  std::size_t end;
};

Places depth_first(const std::vector<Node>& nodes) {
  Places places{std::vector<std::size_t>(nodes.size()), 0};
  std::vector<std::size_t> rest{0};
  while (!rest.empty()) {
    const std::size_t i = rest.back();
    const Node& node = nodes[i];
    rest.pop_back();
    places.of_node[i] = places.end;
    places.end += node.first != 0 ? kTreeNode : node.saved.size();
    if (node.first != 0) rest.push_back(node.second), rest.push_back(node.first);
  }
  return places;
}

/// The nodes of the top, each with its place, and the pieces.
Column<std::byte> joined(const std::vector<Node>& nodes) {
  const Places places = depth_first(nodes);
  Column<std::byte> saved(places.end);
  parallel_for(nodes.size(), 1, [&](std::size_t i) {
    const Node& node = nodes[i];
    std::byte* const at = saved.data() + places.of_node[i];
    if (node.first == 0)
      std::memcpy(at, node.saved.data(), node.saved.size());
    else
      put(at, saved_node(node.axis, nodes[node.first].box, nodes[node.second].box));
  });
  return saved;
}

}  // namespace

std::array<std::byte, kTreeNode> saved_node(int axis, const Bounds& first, const Bounds& second) {
  std::array<std::byte, kTreeNode> node{};
  put(&node[kAxis], axis);
  put(&node[kLow], first.hi[axis]);
  put(&node[kHigh], second.lo[axis]);
  return node;
}

// No points of its own, no names, none removed, not reordered.
std::array<std::byte, kTreeOrder> saved_index(std::uint64_t points, int leaf_size, const Bounds& box) {
  std::array<std::byte, kTreeOrder> index{};
  put(&index[0], points), put(&index[8], std::uint64_t{3}), put(&index[16], points);
  put(&index[51], leaf_size);
  put(&index[55], std::uint64_t{3});
  for (int c = 0; c < 3; ++c) {
    const std::size_t side = kTreeBox + 8 * static_cast<std::size_t>(c);
    put(&index[side], box.lo[c]), put(&index[side + 4], box.hi[c]);
  }
  put(&index[kTreeOrder - 8], points);
  return index;
}

Column<std::byte> build_nodes(std::span<TreePoint> points, std::size_t begin, int leaf_size, Bounds& box) {
  std::vector<Node> nodes = build_top(points, box);
  build_pieces(points, begin, leaf_size, nodes);
  box = nodes.front().box;
  return joined(nodes);
}

Column<std::byte> build_tree(std::span<const Vec3> points, int leaf_size) {
  Column<TreePoint> all(points.size());
  parallel_for(all.size(), kCopyChunk, [&](std::size_t i) {
    all[i] = {points[i], static_cast<std::int32_t>(i)};
  });
  Bounds box = tight_box_in_parallel(all);
  const Column<std::byte> nodes = build_nodes(all, 0, leaf_size, box);
  const std::size_t begin = kTreeOrder + sizeof(std::int32_t) * all.size();
  Column<std::byte> saved(begin + nodes.size());
  put(saved.data(), saved_index(points.size(), leaf_size, box));
  parallel_for(all.size(), kCopyChunk,
               [&](std::size_t i) { put(saved.data() + kTreeOrder + sizeof(std::int32_t) * i, all[i].row); });
  parallel_chunks(nodes.size(), kCopyChunk, [&](std::size_t first, std::size_t end) {
    std::memcpy(saved.data() + begin + first, nodes.data() + first, end - first);
  });
  return saved;
}

}  // namespace phos::inline photon
