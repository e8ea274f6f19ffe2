#include "scene/obj/solid_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "scene/connected_parts.h"

namespace phos::inline scene {
namespace {

/// A part of less volume than this share of the cube of its size is a folded sheet.
constexpr double kFlat = 1e-7;

}  // namespace

SolidParts find_solid_parts(const std::vector<Vec3>& corner) {
  const std::size_t triangles = corner.size() / 3;
  const ConnectedParts connected = find_connected_parts(corner);
  struct Part {
    bool closed = true;
    double volume_m3 = 0;
    DVec3 start{0};
    Bounds box;
  };
  std::vector<Part> parts(connected.parts);
  struct Edge {
    std::size_t part = 0;
    int uses = 0;
  };
  std::map<std::pair<std::size_t, std::size_t>, Edge> edges;
  for (std::size_t t = 0; t < triangles; ++t) {
    Part& part = parts[connected.part[t]];
    if (part.box.empty()) part.start = corner[3 * t];
    DVec3 p[3];
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = DVec3(corner[3 * t + k]) - part.start;
      part.box.include(corner[3 * t + k]);
      const std::size_t a = connected.place[3 * t + k], b = connected.place[3 * t + (k + 1) % 3];
      if (a == b) continue;
      Edge& edge = edges[std::minmax(a, b)];
      edge.part = connected.part[t], ++edge.uses;
    }
    part.volume_m3 += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
  }
  for (const auto& [ends, edge] : edges)
    if (edge.uses % 2 != 0) parts[edge.part].closed = false;
  for (Part& part : parts) {
    const double size_m = static_cast<double>(part.box.diagonal_m());
    part.closed &= std::fabs(part.volume_m3) > kFlat * size_m * size_m * size_m;
  }
  SolidParts result{std::vector<bool>(triangles), std::vector<bool>(triangles)};
  for (std::size_t t = 0; t < triangles; ++t) {
    const Part& part = parts[connected.part[t]];
    result.closed[t] = part.closed;
    result.inside_out[t] = part.closed && part.volume_m3 < 0;
  }
  return result;
}

}  // namespace phos::inline scene
