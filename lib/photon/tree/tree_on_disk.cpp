#include "photon/tree/tree_on_disk.h"

#include <algorithm>

#include "core/interrupt.h"
#include "core/progress.h"
#include "photon/tree/build.h"
#include "photon/tree/split.h"

namespace phos::inline photon {
namespace {

/// Of a point while the tree is built over it in memory: the point, its share of the nodes, twice, and of the
/// swaps.
constexpr std::size_t kBytesInMemory = 40;
/// Points of one reading or writing.
constexpr std::size_t kMostAtATime = 1 << 17;

class TreeOnDisk {
 public:
  TreeOnDisk(ScratchFile& points, int leaf_size, std::uint64_t memory_bytes, const std::string& output)
      : points_(points),
        nodes_(output),
        leaf_size_(leaf_size),
        in_memory_(std::max<std::size_t>(memory_bytes / kBytesInMemory, static_cast<std::size_t>(leaf_size))),
        at_a_time_(std::clamp<std::size_t>(in_memory_ / 8, 1, kMostAtATime)) {}

  void write(std::size_t count, ScratchFile& contents) {
    Bounds box = tight_box_of(0, count);
    {
      Progress progress("building the kd-tree", count, "photons");
      divide(0, count, box, progress);
    }
    contents.write(saved_index(count, leaf_size_, box));
    Column<std::int32_t> rows;
    for_points(0, count, [&](std::span<const TreePoint> points) {
      rows.clear();
      for (const TreePoint& p : points) rows.push_back(p.row);
      contents.write_values<std::int32_t>(rows);
    });
    Column<std::byte> nodes;
    for (std::uint64_t at = 0; at < nodes_.size(); at += nodes.size()) {
      nodes.resize(std::min<std::uint64_t>(nodes_.size() - at, at_a_time_ * sizeof(TreePoint)));
      nodes_.read_at(at, nodes);
      contents.write(nodes);
    }
  }

 private:
  Column<TreePoint> read(std::size_t begin, std::size_t end) {
    Column<TreePoint> points(end - begin);
    points_.read_at(begin * sizeof(TreePoint), std::as_writable_bytes(std::span(points)));
    return points;
  }

  void write_back(std::size_t begin, std::span<const TreePoint> points) {
    points_.write_at(begin * sizeof(TreePoint), std::as_bytes(points));
  }

  template <class Act>
  void for_points(std::size_t begin, std::size_t end, const Act& act) {
    for (; begin < end; begin += at_a_time_) {
      throw_if_interrupted();
      act(std::span<const TreePoint>(read(begin, std::min(end, begin + at_a_time_))));
    }
  }

  Bounds tight_box_of(std::size_t begin, std::size_t end) {
    Bounds box;
    bool first = true;
    for_points(begin, end, [&](std::span<const TreePoint> points) {
      const Bounds part = tight_box(points);
      box = first ? part : box_of_both(box, part);
      first = false;
    });
    return box;
  }

  /// `box` becomes the one about the points.
  void divide(std::size_t begin, std::size_t end, Bounds& box, Progress& progress) {
    throw_if_interrupted();
    if (end - begin <= in_memory_) {
      Column<TreePoint> points = read(begin, end);
      nodes_.write(build_nodes(points, begin, leaf_size_, box));
      write_back(begin, points);
      progress.advance(end - begin);
      return;
    }
    const std::uint64_t at = nodes_.size();
    nodes_.write(saved_node(0, box, box));  // its place
    const TreeSplit split = split_on_disk(begin, end, box);
    Bounds first = box, second = box;
    first.hi[split.axis] = second.lo[split.axis] = split.plane;
    divide(begin, begin + split.first, first, progress);
    divide(begin + split.first, end, second, progress);
    nodes_.write_at(at, saved_node(split.axis, first, second));
    box = box_of_both(first, second);
  }

  TreeSplit split_on_disk(std::size_t begin, std::size_t end, const Bounds& box) {
    const auto [axis, at] = split_plane(box, tight_box_of(begin, end));
    const std::size_t below =
        partition(begin, end, [=](const TreePoint& p) { return p.position[axis] < at; });
    const std::size_t not_above =
        below + partition(begin + below, end, [=](const TreePoint& p) { return p.position[axis] <= at; });
    return {axis, at, first_of_split(end - begin, below, not_above)};
  }

  /// As partition_points(): what both ends have in memory is swapped, until they meet.
  template <class Before>
  std::size_t partition(std::size_t begin, std::size_t end, const Before& before) {
    const std::size_t from = begin, n = at_a_time_;
    while (end - begin > 2 * n) {
      throw_if_interrupted();
      Column<TreePoint> left = read(begin, begin + n), right = read(end - n, end);
      std::size_t l = 0, r = n;
      bool swapped = false;
      for (;;) {
        while (l < n && before(left[l])) ++l;
        while (r > 0 && !before(right[r - 1])) --r;
        if (l == n || r == 0) break;
        std::swap(left[l++], right[--r]);
        swapped = true;
      }
      if (swapped) write_back(begin, left), write_back(end - n, right);
      begin += l, end -= n - r;
    }
    Column<TreePoint> rest = read(begin, end);
    const std::size_t first = partition_points(rest, before);
    write_back(begin, rest);
    return begin - from + first;
  }

  ScratchFile& points_;
  ScratchFile nodes_;
  int leaf_size_;
  std::size_t in_memory_, at_a_time_;
};

}  // namespace

void build_tree_on_disk(ScratchFile& points, std::size_t count, int leaf_size, std::uint64_t memory_bytes,
                        const std::string& output, ScratchFile& contents) {
  TreeOnDisk(points, leaf_size, memory_bytes, output).write(count, contents);
}

}  // namespace phos::inline photon
