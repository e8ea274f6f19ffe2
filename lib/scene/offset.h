// How far rays must start off a triangle so that rounding cannot make them hit it again.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/vector.h"

namespace phos::inline scene {

/// Offset along the normal, m, that keeps a ray from meeting the triangle it starts on. Three roundings add
/// up, in units of the roundoff u = 2^-24:
///  - the point and the shifted origin are each rounded to float: at most 2 sqrt(3) u M along the normal, M
///  the largest
///    |coordinate|; neighbours in the same plane have vertices that are rounded to as much again. 16 covers
///    both.
///  - Embree forms the vertices relative to the origin, a cross product of edges, and two sums of three
///  products (its
///    watertight test, in float): about 12 u L of the longest edge L. 32 covers it.
///  - that cross product's direction is wrong by u a b / |a x b|, which matters for slivers (a, b the edges
///  about the
///    widest angle, |a x b| twice the area). Bounded by 256 L u, so that an area of nearly nothing cannot
///    push rays through its surroundings.
inline float offset_m(const Vec3& p0, const Vec3& p1, const Vec3& p2) {
  constexpr double kRoundoff = 0x1p-24;
  const glm::dvec3 a = glm::dvec3(p1) - glm::dvec3(p0), b = glm::dvec3(p2) - glm::dvec3(p1), c = a + b;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double longest = std::max({la, lb, lc}), shortest = std::min({la, lb, lc});
  const double middle = la + lb + lc - longest - shortest;
  const double twice_area = glm::length(glm::cross(a, b));
  const double sliver =
      twice_area > 0 ? std::min(longest * (shortest * middle / twice_area), 256 * longest) : 0.0;
  double largest = 0;
  for (const Vec3& p : {p0, p1, p2}) {
    for (int i = 0; i < 3; ++i) largest = std::max(largest, static_cast<double>(std::fabs(p[i])));
  }
  return static_cast<float>(kRoundoff * (16 * largest + 32 * longest + sliver));
}

}  // namespace phos::inline scene
