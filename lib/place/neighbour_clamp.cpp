#include "place/neighbour_clamp.h"

#include <algorithm>
#include <array>

namespace phos::inline place {
namespace {

constexpr std::size_t kBucket = 8;
constexpr int kDeepest = 24;

float distance_to(const Bounds& box, const Vec3& p) {
  return glm::length(glm::max(Vec3(0), glm::max(box.lo - p, p - box.hi)));
}

unsigned octant(const Vec3& p, const Vec3& middle) {
  return (p.x >= middle.x ? 1u : 0u) | (p.y >= middle.y ? 2u : 0u) | (p.z >= middle.z ? 4u : 0u);
}

/// Corners are seen by both of their walls; the two sides of one wall do not see each other.
bool facing(const Vec3& a, const Vec3& b) { return glm::dot(a, b) > -0.1f; }

}  // namespace

/// Octree over the points; radii bound the search. `most` may be stale (too large), `least` is kept exact
/// downwards.
struct NeighbourClamp::Node {
  std::array<std::uint32_t, 8> child;
  std::vector<std::uint32_t> points;  // of a leaf
  Bounds box;
  float least = kInfinity, most = 0;
  bool leaf = true;
};

NeighbourClamp::NeighbourClamp(const Bounds& bounds, ClampBy by, float slope) : slope_(slope), by_(by) {
  const float size = max_component(bounds.size());
  side_ = size > 0 && std::isfinite(size) ? size : 1;
  lo_ = bounds.empty() ? Vec3(-0.5f) : bounds.centre() - 0.5f * side_;
  new_node();
}
NeighbourClamp::~NeighbourClamp() = default;

std::uint32_t NeighbourClamp::new_node() {
  nodes_.emplace_back();
  nodes_.back().child.fill(kNone);
  return static_cast<std::uint32_t>(nodes_.size() - 1);
}

void NeighbourClamp::into_child(std::uint32_t node, std::uint32_t point, const Vec3& lo, float side,
                                int depth) {
  const float half = side / 2;
  const unsigned o = octant(points_[point].p, lo + half);
  if (nodes_[node].child[o] == kNone) {
    const std::uint32_t fresh = new_node();
    nodes_[node].child[o] = fresh;
  }
  const Vec3 child_lo = lo + half * Vec3(o & 1u ? 1 : 0, o & 2u ? 1 : 0, o & 4u ? 1 : 0);
  add(nodes_[node].child[o], point, child_lo, half, depth + 1);
}

void NeighbourClamp::add(std::uint32_t node, std::uint32_t point, const Vec3& lo, float side, int depth) {
  const Point& q = points_[point];
  nodes_[node].box.include(q.p);
  nodes_[node].least = std::min(nodes_[node].least, q.spread_m);
  nodes_[node].most = std::max(nodes_[node].most, q.radius_m);
  if (!nodes_[node].leaf) return into_child(node, point, lo, side, depth);
  nodes_[node].points.push_back(point);
  if (nodes_[node].points.size() <= kBucket || depth == kDeepest) return;
  std::vector<std::uint32_t> moved;
  moved.swap(nodes_[node].points);
  nodes_[node].leaf = false;
  for (const std::uint32_t i : moved) into_child(node, i, lo, side, depth);
}

void NeighbourClamp::least(std::uint32_t node, const Point& q, float& best) const {
  const Node& x = nodes_[node];
  if (x.least + slope_ * distance_to(x.box, q.p) >= best) return;
  for (const std::uint32_t i : x.points) {
    if (facing(points_[i].n, q.n))
      best = std::min(best, points_[i].spread_m + slope_ * glm::length(points_[i].p - q.p));
  }
  for (const std::uint32_t c : x.child) {
    if (c != kNone) least(c, q, best);
  }
}

void NeighbourClamp::clamp(std::uint32_t node, const Point& q,
                           const std::function<void(std::size_t, float)>& shrunk) {
  Node& x = nodes_[node];
  if (x.most <= q.radius_m + slope_ * distance_to(x.box, q.p)) return;
  for (const std::uint32_t i : x.points) {
    Point& other = points_[i];
    const float limit = q.radius_m + slope_ * glm::length(other.p - q.p);
    if (other.frozen || other.radius_m <= limit || !facing(other.n, q.n)) continue;
    other.radius_m = other.spread_m = limit;
    x.least = std::min(x.least, limit);
    shrunk(i, limit);
  }
  for (const std::uint32_t c : x.child) {
    if (c == kNone) continue;
    clamp(c, q, shrunk);
    x.least = std::min(x.least, nodes_[c].least);
  }
}

void NeighbourClamp::lower(std::size_t index, float radius_m) {
  Point& point = points_[index];
  if (!(radius_m < point.radius_m)) return;
  point.radius_m = point.spread_m = radius_m;
  Vec3 lo = lo_;
  float half = side_;
  for (std::uint32_t node = 0;;) {
    nodes_[node].least = std::min(nodes_[node].least, radius_m);
    if (nodes_[node].leaf) return;
    half /= 2;
    const unsigned o = octant(point.p, lo + half);
    lo += half * Vec3(o & 1u ? 1 : 0, o & 2u ? 1 : 0, o & 4u ? 1 : 0);
    node = nodes_[node].child[o];
  }
}

float NeighbourClamp::insert(const Vec3& p, const Vec3& n, float radius_m, bool frozen,
                             const std::function<void(std::size_t, float)>& shrunk) {
  Point q{p, n, radius_m, radius_m, frozen};
  if (!frozen) least(0, q, q.radius_m);
  if (by_ == ClampBy::all) clamp(0, q, shrunk);
  q.spread_m = by_ == ClampBy::all || frozen ? q.radius_m : kInfinity;
  points_.push_back(q);
  add(0, static_cast<std::uint32_t>(points_.size() - 1), lo_, side_, 0);
  return q.radius_m;
}

}  // namespace phos::inline place
