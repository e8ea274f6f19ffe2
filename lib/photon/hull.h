// Convex hull of points in a plane (CGAL, exact predicates).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vector.h"

namespace phos::inline photon {

struct Hull {
  std::vector<std::uint32_t>
      vertices;            ///< indices of the extreme points, counter-clockwise; none lies on an edge
  double area = 0;         ///< of the polygon, unit of the points squared; 0 for fewer than 3 vertices
  glm::dvec2 centroid{0};  ///< of the polygon; the mean of the vertices where the area is 0
};

/// Hull of `points`. Points that are not finite are passed over; collinear, coincident and no points at all
/// give a hull of area 0. Exact in its decisions: points that are nearly collinear are safe. Of coincident
/// points one is a vertex.
void convex_hull(std::span<const Vec2> points, Hull& hull);

}  // namespace phos::inline photon
