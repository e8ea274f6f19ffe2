#include "temporal/reprojection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "core/error.h"
#include "core/sampling.h"
#include "estimate/hemisphere/ray_gradients.h"

namespace phos::inline temporal {
namespace {

constexpr double kMostGrowth = 4;  // of the share that a hit covers
constexpr std::size_t kNothing = std::numeric_limits<std::size_t>::max();

/// Turns about z, in [0, 1], to 2e-6 (Abramowitz and Stegun 4.4.47): the same bits on every machine.
float turns_of(float x, float y) {
  const float ax = std::fabs(x), ay = std::fabs(y);
  const float most = std::max(ax, ay);
  if (!(most > 0)) return 0;
  const float t = std::min(ax, ay) / most, t2 = t * t;
  float angle =
      t * (0.9998660f + t2 * (-0.3302995f + t2 * (0.1801410f + t2 * (-0.0851330f + t2 * 0.0208351f))));
  if (ay > ax) angle = kPi / 2 - angle;
  if (x < 0) angle = kPi - angle;
  if (y < 0) angle = 2 * kPi - angle;
  return angle / (2 * kPi);
}

/// The cell that a unit direction (in the frame of h) above the horizon lies in.
std::size_t cell_of(const Hemisphere& h, const Vec3& local) {
  const float sin2 = local.x * local.x + local.y * local.y;
  const float share = h.measure == Measure::solid ? sin2 / (1 + local.z) : sin2;
  const int ring = std::min(static_cast<int>(share * static_cast<float>(h.rings)), h.rings - 1);
  const int slice =
      std::min(static_cast<int>(turns_of(local.x, local.y) * static_cast<float>(h.slices)), h.slices - 1);
  return h.at(ring, slice);
}

Vec3 middle_of(const Hemisphere& h, std::size_t cell) {
  const auto slices = static_cast<std::size_t>(h.slices);
  const float share = (static_cast<float>(cell / slices) + 0.5f) / static_cast<float>(h.rings);
  const Vec2 around = cos_sin((static_cast<float>(cell % slices) + 0.5f) / static_cast<float>(h.slices));
  const bool solid = h.measure == Measure::solid;
  const float sin2 = solid ? share * (2 - share) : share;
  const float z = solid ? 1 - share : std::sqrt(1 - sin2);
  return h.frame.to_world(Vec3(std::sqrt(sin2) * around, z));
}

DVec3 point_of(const Scene& scene, const Hit& hit) {
  const auto& v = scene.triangle[hit.triangle].v;
  const double a = hit.u, b = hit.v;
  return (1 - a - b) * DVec3(scene.position[v[0]]) + a * DVec3(scene.position[v[1]]) +
         b * DVec3(scene.position[v[2]]);
}

/// Normal at the second time of the side that was hit; 0 where there is no surface any more.
Vec3 turned_normal(const Motion& motion, std::uint32_t triangle, const Vec3& normal) {
  const float side = glm::dot(geometric_normal(motion.now, triangle), normal);
  const Vec3 next = geometric_normal(motion.next, triangle);
  return side < 0 ? -next : next;
}

/// Sets direction, distance and normal of hit i as seen at the second time. False where it is out of sight.
bool move(const Hemisphere& now, const Hit& hit, std::size_t i, const Motion& motion, const Vec3& shift_m,
          Hemisphere& moved) {
  const bool escaped = !std::isfinite(now.distance_m[i]);
  const bool moves = !escaped && motion.moves(hit.triangle);
  const Vec3 change = moves ? motion.of(hit) - shift_m : -shift_m;
  moved.direction[i] = now.direction[i];
  moved.distance_m[i] = now.distance_m[i];
  moved.hit_normal[i] = moves ? turned_normal(motion, hit.triangle, now.hit_normal[i]) : now.hit_normal[i];
  if (escaped || (!moves && change == Vec3(0))) return true;

  const DVec3 way = static_cast<double>(now.distance_m[i]) * DVec3(now.direction[i]) + DVec3(change);
  const double distance = glm::length(way);
  if (!(distance > 0) || !std::isfinite(distance)) return false;
  moved.direction[i] = Vec3(way / distance), moved.distance_m[i] = static_cast<float>(distance);
  return glm::dot(moved.direction[i], moved.hit_normal[i]) < 0;
}

/// Neighbours of a cell, up to four.
template <class Visit>
void each_neighbour(const Hemisphere& h, std::size_t cell, const Visit& visit) {
  const int ring = static_cast<int>(cell) / h.slices, slice = static_cast<int>(cell) % h.slices;
  if (ring > 0) visit(h.at(ring - 1, slice));
  if (ring + 1 < h.rings) visit(h.at(ring + 1, slice));
  visit(h.at(ring, slice - 1)), visit(h.at(ring, slice + 1));
}

/// Fills each empty cell with the light of its deepest known neighbour, the deepest first.
void flood(const Hemisphere& h, const Hemisphere& moved, std::vector<std::size_t>& source) {
  struct Front {
    float depth_m;
    std::size_t cell;
    bool operator<(const Front& other) const {
      return depth_m != other.depth_m ? depth_m < other.depth_m : cell > other.cell;
    }
  };
  std::priority_queue<Front> fronts;
  for (std::size_t cell = 0; cell < source.size(); ++cell) {
    if (source[cell] != kNothing) continue;
    each_neighbour(h, cell, [&](std::size_t n) {
      if (source[n] != kNothing) fronts.push({moved.distance_m[source[n]], n});
    });
  }
  while (!fronts.empty()) {
    const Front front = fronts.top();
    fronts.pop();
    each_neighbour(h, front.cell, [&](std::size_t n) {
      if (source[n] != kNothing) return;
      source[n] = source[front.cell];
      fronts.push({front.depth_m, n});
    });
  }
}

/// The share of the hemisphere's measure that a hit covers at the second time, over its former share:
/// cos(theta) cos(xi) / r^2, the first cosine in projected solid angle alone.
double growth(const Hemisphere& now, const Hemisphere& moved, std::size_t i, const Vec3& normal) {
  const auto dot = [](const Vec3& a, const Vec3& b) { return static_cast<double>(glm::dot(a, b)); };
  double before = 1, after = 1;
  if (now.measure == Measure::projected)
    before *= dot(now.direction[i], now.frame.z), after *= dot(moved.direction[i], normal);
  if (std::isfinite(now.distance_m[i])) {
    const double nearer = static_cast<double>(now.distance_m[i]) / static_cast<double>(moved.distance_m[i]);
    before *= -dot(now.direction[i], now.hit_normal[i]);
    after *= -dot(moved.direction[i], moved.hit_normal[i]) * nearer * nearer;
  }
  // At a grazing angle it means little.
  return before > 0 ? std::clamp(after / before, 0.0, kMostGrowth) : 1;
}

/// Hits, moved, and the cells that they fall into.
struct Moved {
  Hemisphere h;                    // by hit
  std::vector<std::uint8_t> goes;  // by hit: it moves itself
  std::vector<std::uint8_t> seen;  // by hit
  std::vector<std::size_t> cell;   // by hit
  std::vector<float> covers;       // by hit, in cells
  std::vector<std::size_t> front;  // by cell: the nearest hit in it

  /// Are these two of surfaces of which one may come to hide the other?
  bool apart(std::size_t a, std::size_t b) const { return goes[a] != goes[b] || one_hides_other(h, a, b, 0); }
};

/// The shares that hits cover and the holes must make up the whole. The difference belongs to surfaces behind
/// the edges of nearer ones: hits there cover the more or the less for it, up to nothing or the double.
/// Returns how much they took.
double take_behind_edges(const Hemisphere& cells, double missing, bool place_moves, Moved& moved) {
  std::vector<std::size_t> behind;
  double cover = 0;
  for (std::size_t i = 0; i < moved.seen.size(); ++i) {
    if (!moved.seen[i] || !(moved.covers[i] > 0)) continue;
    bool edge = false;
    each_neighbour(cells, moved.cell[i], [&](std::size_t n) {
      const std::size_t f = moved.front[n];
      if (edge || f == kNothing || !(moved.h.distance_m[f] < moved.h.distance_m[i])) return;
      edge = place_moves ? moved.apart(i, f) : moved.goes[i] != moved.goes[f];
    });
    if (!edge) continue;
    behind.push_back(i), cover += static_cast<double>(moved.covers[i]);
  }
  if (behind.empty()) return 0;
  const double share = std::clamp(missing / cover, -1.0, 1.0);
  for (const std::size_t i : behind) moved.covers[i] *= static_cast<float>(1 + share);
  return share * cover;
}

}  // namespace

Vec3 Motion::of(const Hit& hit) const {
  return moves(hit.triangle) ? Vec3(point_of(next, hit) - point_of(now, hit)) : Vec3(0);
}

ReprojectionCounts reproject(const Hemisphere& now, std::span<const Hit> hits, std::span<const Rgb> radiance,
                             const Motion& motion, const Vec3& shift_m, const Frame& frame,
                             Hemisphere& ahead) {
  const std::size_t n = now.size();
  PHOS_CHECK(now.stratified() && hits.size() == n && radiance.size() == n, n, " rays, ", hits.size(),
             " hits, ", radiance.size(), " radiances");
  const bool turns = frame.x != now.frame.x || frame.z != now.frame.z;
  ahead.frame = frame, ahead.rings = now.rings, ahead.slices = now.slices, ahead.measure = now.measure;
  ahead.resize(n);
  ReprojectionCounts counts{.cells = n};

  Moved moved;
  Hemisphere& h = moved.h;
  h.resize(n);
  moved.goes.resize(n), moved.seen.resize(n), moved.cell.resize(n);
  moved.covers.assign(n, 1), moved.front.assign(n, kNothing);
  for (std::size_t i = 0; i < n; ++i) {
    moved.goes[i] = std::isfinite(now.distance_m[i]) && motion.moves(hits[i].triangle);
    moved.seen[i] = move(now, hits[i], i, motion, shift_m, h);
    moved.cell[i] = i;
    if (turns || h.direction[i] != now.direction[i]) {
      const Vec3 local = frame.to_local(h.direction[i]);
      moved.seen[i] = moved.seen[i] && local.z > 0;
      if (!moved.seen[i]) continue;
      moved.cell[i] = cell_of(ahead, local);
      moved.covers[i] = static_cast<float>(growth(now, h, i, frame.z));
    }
    if (!moved.seen[i]) continue;
    std::size_t& nearest = moved.front[moved.cell[i]];
    if (nearest == kNothing || h.distance_m[i] < h.distance_m[nearest]) nearest = i;
  }

  double covered = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (moved.seen[i]) {
      const std::size_t nearest = moved.front[moved.cell[i]];
      moved.seen[i] = nearest == i || !moved.apart(i, nearest);
    }
    if (moved.seen[i])
      covered += static_cast<double>(moved.covers[i]);
    else
      ++counts.hidden;
  }

  // The missing share came into sight, mostly in cells that another surface has left.
  std::vector<std::size_t> source = moved.front, holes;
  for (std::size_t cell = 0; cell < n; ++cell)
    if (source[cell] == kNothing) ++counts.empty;
  if (counts.empty > 0) flood(ahead, h, source);
  for (std::size_t cell = 0; cell < n; ++cell) {
    if (moved.front[cell] != kNothing) continue;
    const bool known = source[cell] != kNothing;
    if (!moved.seen[cell] || !known || moved.apart(cell, source[cell]))
      holes.push_back(cell);
    else
      source[cell] = cell;
  }
  const auto all = static_cast<double>(n), most = static_cast<double>(holes.size());
  counts.holes = std::clamp(all - covered, 0.0, most);
  covered += counts.holes;
  if (covered != all) covered += take_behind_edges(ahead, all - covered, turns || shift_m != Vec3(0), moved);

  // What is seen takes its light to its cell.
  std::fill(ahead.radiance.begin(), ahead.radiance.end(), Rgb(0));
  for (std::size_t i = 0; i < n; ++i)
    if (moved.seen[i]) ahead.radiance[moved.cell[i]] += radiance[i] * moved.covers[i];
  for (const std::size_t cell : holes)
    if (source[cell] != kNothing)
      ahead.radiance[cell] = radiance[source[cell]] * static_cast<float>(counts.holes / most);
  if (covered > 0 && covered != all) {
    const auto scale = static_cast<float>(std::min(all / covered, kMostGrowth));
    for (Rgb& light : ahead.radiance) light *= scale;
  }

  const float each_sr = kPi / static_cast<float>(n);
  for (std::size_t cell = 0; cell < n; ++cell) {
    const std::size_t hit = source[cell];
    const bool fell_in = moved.front[cell] != kNothing;
    ahead.direction[cell] = fell_in ? h.direction[hit] : middle_of(ahead, cell);
    ahead.distance_m[cell] = hit == kNothing ? kInfinity : h.distance_m[hit];
    ahead.hit_normal[cell] = hit == kNothing ? -ahead.direction[cell] : h.hit_normal[hit];
    if (!fell_in && !(glm::dot(ahead.direction[cell], ahead.hit_normal[cell]) < 0))
      ahead.hit_normal[cell] = -ahead.direction[cell];
    const bool kept = !turns && ahead.direction[cell] == now.direction[cell];
    const float z = now.measure == Measure::solid ? glm::dot(ahead.direction[cell], frame.z) : 0.5f;
    ahead.projected_sr[cell] = kept ? now.projected_sr[cell] : each_sr * 2 * z;
  }
  return counts;
}

}  // namespace phos::inline temporal
