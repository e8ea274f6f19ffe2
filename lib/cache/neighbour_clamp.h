// Radii that grow no faster than distance (neighbour clamping, Krivanek et al. 2006; FORMULAS A7).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/vector.h"

namespace phos {

/// Keeps R_i <= R_j + |p_i - p_j| for every pair of points that face the same half space, while points are
/// added. A radius that is small because something is near thereby warns its neighbourhood of what they may
/// have missed.
class NeighbourClamp {
 public:
  explicit NeighbourClamp(const Bounds& bounds);
  ~NeighbourClamp();

  /// Adds a point and returns its radius as clamped by those there are; then clamps theirs, calling
  /// shrunk(index, radius) for each that changes (indices count insertions). A frozen point clamps others but
  /// is never clamped.
  float insert(const Vec3& p, const Vec3& n, float radius_m, bool frozen,
               const std::function<void(std::size_t, float)>& shrunk);
  float radius_m(std::size_t index) const { return points_[index].radius_m; }
  std::size_t size() const { return points_.size(); }

 private:
  struct Point {
    Vec3 p, n;
    float radius_m;
    bool frozen;
  };
  struct Node;
  static constexpr std::uint32_t kNone = ~0u;
  std::uint32_t new_node();
  void add(std::uint32_t node, std::uint32_t point, const Vec3& lo, float side, int depth);
  void into_child(std::uint32_t node, std::uint32_t point, const Vec3& lo, float side, int depth);
  void least(std::uint32_t node, const Point& q, float& best) const;
  void clamp(std::uint32_t node, const Point& q, const std::function<void(std::size_t, float)>& shrunk);

  std::vector<Point> points_;
  std::vector<Node> nodes_;
  Vec3 lo_;
  float side_;
};

}  // namespace phos
