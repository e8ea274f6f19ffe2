// Radii that grow no faster than distance (neighbour clamping, Krivanek et al. 2006; docs/methods.md#a7).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/vector.h"

namespace phos::inline place {

/// Which points clamp others.
enum class ClampBy {
  all,     ///< every point those there are, and those added after it
  judged,  ///< frozen ones and those that were lowered, those added after them
};

/// Keeps R_i <= R_j + slope |p_i - p_j| for every pair of points that face the same half space, while points
/// are added, as far as ClampBy says. A radius that is small because something is near thereby warns its
/// neighbours of surfaces that they may have missed.
class NeighbourClamp {
 public:
  explicit NeighbourClamp(const Bounds& bounds, ClampBy by = ClampBy::all, float slope = 1);
  ~NeighbourClamp();

  /// Adds a point and returns its radius as clamped by those there are; then clamps theirs, calling
  /// shrunk(index, radius) for each that changes (indices count insertions). A frozen point clamps others but
  /// is never clamped.
  float insert(const Vec3& p, const Vec3& n, float radius_m, bool frozen,
               const std::function<void(std::size_t, float)>& shrunk);
  /// Lowers a point's radius; those added after it are clamped by that, those before are not.
  void lower(std::size_t index, float radius_m);
  float radius_m(std::size_t index) const { return points_[index].radius_m; }
  std::size_t size() const { return points_.size(); }

 private:
  struct Point {
    Vec3 p, n;
    float radius_m;
    float spread_m;  // by which it clamps others; infinity: not at all
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
  float side_, slope_;
  ClampBy by_;
};

}  // namespace phos::inline place
