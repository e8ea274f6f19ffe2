#include "scene/solid_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace phos {
namespace {

/// A part of less volume than this share of the cube of its size is a folded sheet.
constexpr double kFlat = 1e-7;

}  // namespace

SolidParts find_solid_parts(const std::vector<Vec3>& corner) {
  const std::size_t triangles = corner.size() / 3;
  std::map<std::array<float, 3>, std::size_t> places;
  std::vector<std::size_t> place(3 * triangles);
  for (std::size_t i = 0; i < place.size(); ++i) {
    const Vec3 p = corner[i] + 0.0f;  // -0 is 0
    place[i] = places.try_emplace({p.x, p.y, p.z}, places.size()).first->second;
  }
  std::vector<std::size_t> parent(places.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t k = 1; k < 3; ++k) parent[root(place[3 * t])] = root(place[3 * t + k]);

  struct Part {
    bool closed = true;
    double volume_m3 = 0;
    DVec3 start{0};
    Bounds box;
  };
  std::map<std::size_t, Part> parts;
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [found, fresh] = parts.try_emplace(root(place[3 * t]));
    Part& part = found->second;
    if (fresh) part.start = corner[3 * t];
    DVec3 p[3];
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = DVec3(corner[3 * t + k]) - part.start;
      part.box.include(corner[3 * t + k]);
      const std::size_t a = place[3 * t + k], b = place[3 * t + (k + 1) % 3];
      if (a != b) ++edges[std::minmax(a, b)];
    }
    part.volume_m3 += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
  }
  for (const auto& [edge, uses] : edges)
    if (uses % 2 != 0) parts[root(edge.first)].closed = false;
  for (auto& [first, part] : parts) {
    const double size_m = static_cast<double>(part.box.diagonal_m());
    part.closed &= std::fabs(part.volume_m3) > kFlat * size_m * size_m * size_m;
  }
  SolidParts result{std::vector<bool>(triangles), std::vector<bool>(triangles)};
  for (std::size_t t = 0; t < triangles; ++t) {
    const Part& part = parts[root(place[3 * t])];
    result.closed[t] = part.closed;
    result.inside_out[t] = part.closed && part.volume_m3 < 0;
  }
  return result;
}

}  // namespace phos
