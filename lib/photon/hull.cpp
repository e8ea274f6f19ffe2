#include "photon/hull.h"

#include <CGAL/Convex_hull_traits_adapter_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <exception>
#include <iterator>

#include "core/error.h"
#include "core/float_traps.h"

namespace phos::inline photon {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PointMap = CGAL::Pointer_property_map<Kernel::Point_2>::type;
using Traits = CGAL::Convex_hull_traits_adapter_2<Kernel, PointMap>;

struct Scratch {
  std::vector<Kernel::Point_2> points;
  std::vector<std::size_t> finite, outer, extreme;
  std::vector<float> x, y, inside;
};

/// Picks the finite points that can be vertices: all but those inside of the octagon of the points
/// that lie furthest in eight directions (Akl and Toussaint 1978), some hundreds being asked. Told in floats,
/// with room for rounding: exact work is left for the few near the rim. `x` and `y` lie within 1/2 of the
/// origin.
void pick_outer(Scratch& s) {
  constexpr float kRoom = 1e-5f;
  constexpr float kAcross[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  const std::size_t n = s.x.size(), step = 1 + n / 256;
  std::size_t corner[8]{};
  for (std::size_t k = 0; k < 4; ++k) {  // and the opposite direction
    const float dx = kAcross[k][0], dy = kAcross[k][1];
    float most = -HUGE_VALF, least = HUGE_VALF;
    for (std::size_t i = 0; i < n; i += step) {
      const float along = dx * s.x[i] + dy * s.y[i];
      if (along > most) most = along, corner[k] = i;
      if (along < least) least = along, corner[k + 4] = i;
    }
  }
  s.inside.assign(n, HUGE_VALF);
  for (std::size_t k = 0; k < 8; ++k) {
    const std::size_t a = corner[k], b = corner[(k + 1) % 8];
    if (a == b) continue;
    const float nx = s.y[a] - s.y[b], ny = s.x[b] - s.x[a], offset = nx * s.x[a] + ny * s.y[a];
    for (std::size_t i = 0; i < n; ++i) {
      s.inside[i] = std::min(s.inside[i], nx * s.x[i] + ny * s.y[i] - offset);
    }
  }
  s.outer.clear();
  for (std::size_t i = 0; i < n; ++i) {
    if (!(s.inside[i] > kRoom && s.inside[i] < HUGE_VALF)) s.outer.push_back(s.finite[i]);
  }
}

/// Area and centroid of the polygon, relative to its first vertex so that nothing cancels.
void measure(std::span<const Vec2> points, Hull& hull) {
  hull.area = 0, hull.centroid = glm::dvec2(0);
  if (hull.vertices.empty()) return;
  const glm::dvec2 first(points[hull.vertices[0]]);
  glm::dvec2 moment(0), sum(0);
  for (std::size_t i = 1; i + 1 < hull.vertices.size(); ++i) {
    const glm::dvec2 a = glm::dvec2(points[hull.vertices[i]]) - first;
    const glm::dvec2 b = glm::dvec2(points[hull.vertices[i + 1]]) - first;
    const double twice = a.x * b.y - a.y * b.x;
    hull.area += twice / 2;
    moment += twice / 6 * (a + b);
  }
  for (const std::uint32_t v : hull.vertices) sum += glm::dvec2(points[v]) - first;
  hull.area = std::max(hull.area, 0.0);
  hull.centroid =
      first + (hull.area > 0 ? moment / hull.area : sum / static_cast<double>(hull.vertices.size()));
}

}  // namespace

void convex_hull(std::span<const Vec2> points, Hull& hull) {
  thread_local Scratch scratch;
  scratch.points.resize(points.size());
  scratch.finite.clear(), scratch.extreme.clear(), hull.vertices.clear();
  glm::dvec2 lo(HUGE_VAL), hi(-HUGE_VAL);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y)) continue;
    scratch.finite.push_back(i);
    lo = glm::min(lo, glm::dvec2(points[i])), hi = glm::max(hi, glm::dvec2(points[i]));
  }
  if (scratch.finite.empty()) return measure(points, hull);
  const glm::dvec2 centre = (lo + hi) / 2.0;
  const double size = std::max(hi.x - lo.x, hi.y - lo.y), scale = size > 0 ? 1 / size : 1;
  const auto scaled = [&](std::size_t i) { return (glm::dvec2(points[i]) - centre) * scale; };
  scratch.x.clear(), scratch.y.clear();
  for (const std::size_t i : scratch.finite) {
    const Vec2 q(scaled(i));
    scratch.x.push_back(q.x), scratch.y.push_back(q.y);
  }
  pick_outer(scratch);
  for (const std::size_t i : scratch.outer) {
    const glm::dvec2 q = scaled(i);
    scratch.points[i] = Kernel::Point_2(q.x, q.y);
  }
  try {
    const NoFloatTraps traps;  // CGAL's intervals may be unbounded
    CGAL::convex_hull_2(scratch.outer.begin(), scratch.outer.end(), std::back_inserter(scratch.extreme),
                        Traits(CGAL::make_property_map(scratch.points)));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw Error(ExitCode::numerical, "",
                text("convex hull of ", points.size(), " photons failed: ", e.what()));
  }
  for (const std::size_t i : scratch.extreme) hull.vertices.push_back(static_cast<std::uint32_t>(i));
  measure(points, hull);
}

}  // namespace phos::inline photon
