#include "photon/tree/check.h"

#include <limits>
#include <vector>

#include "core/float_traps.h"
#include "photon/tree/flann_stream.h"

namespace phos::inline photon {
namespace {

using Damaged = FlannStream::Damaged;

/// Threads may take denormals for zero when they build, or when they check.
constexpr float kZero = std::numeric_limits<float>::min();

void require(bool good, const char* otherwise) {
  if (!good) throw Damaged(otherwise);
}

bool contains(const Bounds& outer, const Bounds& inner) {
  for (int c = 0; c < 3; ++c)
    if (!(outer.lo[c] <= inner.lo[c] + kZero && outer.hi[c] >= inner.hi[c] - kZero)) return false;
  return true;
}

/// An inner node whose children are not all read.
struct Open {
  int axis;
  float low, high;  // the first child ends and the second begins there
  bool first_read = false;
  Bounds first{};
};

class Checker {
 public:
  Checker(std::span<const Vec3> points, const TreeStream& stream)
      : points_(points), in_(stream.bytes, stream.header_bytes, stream.first_block) {}

  void check() {
    const NoFloatTraps traps;  // files may hold numbers that are not finite
    read_index();
    read_order();
    const Bounds all = read_nodes();
    require(leaves_end_ == points_.size(), "lacks leaves");
    require(contains(box_, all), "has a box that does not hold the photons");
    in_.require_end();
  }

 private:
  /// The members that FLANN keeps of every index, then the members of this kind.
  void read_index() {
    require(in_.take<std::uint64_t>() == points_.size(), "is over another number of points");
    require(in_.take<std::uint64_t>() == 3, "is not over points in space");
    require(in_.take<std::uint64_t>() == points_.size(), "was built over another number of points");
    require(!in_.take_bool(), "brings points of its own");
    in_.take<std::uint64_t>();  // the next point's name, if any were added
    require(in_.take<std::uint64_t>() == 0, "has names for its points");
    require(!in_.take_bool() && in_.take<std::uint64_t>() == 0, "lacks points");
    require(!in_.take_bool(), "has points in an order of its own");
    in_.take<std::int32_t>();  // the leaf size that it was built for
    require(in_.take<std::uint64_t>() == 3, "has a box that is not in space");
    for (int c = 0; c < 3; ++c) box_.lo[c] = in_.take<float>(), box_.hi[c] = in_.take<float>();
  }

  void read_order() {
    require(in_.take<std::uint64_t>() == points_.size(), "lists another number of points");
    order_.resize(points_.size());
    std::vector<bool> listed(points_.size());
    for (std::int32_t& i : order_) {
      i = in_.take<std::int32_t>();
      require(i >= 0 && static_cast<std::size_t>(i) < points_.size(), "lists a photon that is not there");
      require(!listed[static_cast<std::size_t>(i)], "lists a photon twice");
      listed[static_cast<std::size_t>(i)] = true;
    }
  }

  /// Depth first, as they are saved; returns the box about all leaves.
  Bounds read_nodes() {
    std::vector<Open> above;
    for (;;) {
      const auto left = in_.take<std::int32_t>(), right = in_.take<std::int32_t>();
      Open node{in_.take<std::int32_t>(), 0, 0};
      node.low = in_.take<float>(), node.high = in_.take<float>();
      if (!in_.take_bool()) {
        require(node.axis >= 0 && node.axis < 3, "has a plane along no axis");
        require(node.low <= node.high, "has a plane that is not one");
        require(above.size() < kDeepestTree, "is too deep");
        above.push_back(node);
        continue;
      }
      Bounds box = leaf(left, right);
      while (!above.empty() && above.back().first_read) {
        const Open& parent = above.back();
        require(box.lo[parent.axis] >= parent.high - kZero,
                "has photons before a plane that belong behind it");
        box.include(parent.first.lo), box.include(parent.first.hi);
        above.pop_back();
      }
      if (above.empty()) return box;
      Open& parent = above.back();
      require(box.hi[parent.axis] <= parent.low + kZero, "has photons behind a plane that belong before it");
      parent.first = box, parent.first_read = true;
    }
  }

  Bounds leaf(std::int32_t left, std::int32_t right) {
    require(left >= 0 && static_cast<std::size_t>(left) == leaves_end_ && right > left &&
                static_cast<std::size_t>(right) <= points_.size(),
            "has leaves that do not follow each other");
    leaves_end_ = static_cast<std::size_t>(right);
    Bounds box;
    for (std::int32_t i = left; i < right; ++i)
      box.include(points_[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])]);
    return box;
  }

  std::span<const Vec3> points_;
  FlannStream in_;
  Bounds box_;
  std::vector<std::int32_t> order_;
  std::size_t leaves_end_ = 0;
};

}  // namespace

void check_tree(std::span<const Vec3> points, const TreeStream& stream) { Checker(points, stream).check(); }

}  // namespace phos::inline photon
