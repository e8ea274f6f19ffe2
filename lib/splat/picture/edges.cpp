#include "splat/picture/edges.h"

#include <cmath>

#include "core/parallel.h"

namespace phos::inline splat {
namespace {

constexpr float kSameDirection = 0.966f;  // cos 15 degrees
/// Sine of the slope at which a neighbour leaves the pixel's tangent plane. Smooth normals of a coarse mesh
/// differ from its facets by less.
constexpr float kSamePlane = 0.3f;

/// Length, in gaps between the two places, from which on a triangle's neighbours should be next to it.
constexpr float kLong = 4;

/// Do two triangles of one plane meet nowhere, although they are large for the gap between the places seen on
/// them? Then something narrow may stand in between.
bool apart(const Scene& scene, const GBuffer& g, std::size_t i, std::size_t j) {
  const Triangle &a = scene.triangle[g.hit[i].triangle], &b = scene.triangle[g.hit[j].triangle];
  float longest_m = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3& corner = scene.position[a.v[k]];
    for (const std::uint32_t other : b.v)
      if (corner == scene.position[other]) return false;
    longest_m = std::fmax(longest_m, glm::distance(corner, scene.position[a.v[(k + 1) % 3]]));
  }
  return longest_m > kLong * glm::distance(Vec3(g.position[i]), Vec3(g.position[j]));
}

bool differ(const Scene& scene, const GBuffer& g, std::size_t i, std::size_t j) {
  if (g.covered(i) != g.covered(j)) return true;
  if (!g.covered(i) || g.hit[i].triangle == g.hit[j].triangle) return false;
  if (g.albedo[i].w != g.albedo[j].w) return true;
  const Vec3 a(g.normal[i]), b(g.normal[j]);
  if (glm::dot(a, b) < kSameDirection) return true;
  const Vec3 way = Vec3(g.position[j]) - Vec3(g.position[i]);
  const float off = std::fmax(std::fabs(glm::dot(a, way)), std::fabs(glm::dot(b, way)));
  return off > kSamePlane * glm::length(way) || apart(scene, g, i, j) || apart(scene, g, j, i);
}

}  // namespace

std::vector<std::uint32_t> edge_pixels(const Scene& scene, const GBuffer& g) {
  using Pixels = std::vector<std::uint32_t>;
  const auto width = static_cast<std::size_t>(g.width), height = static_cast<std::size_t>(g.height);
  return parallel_reduce(
      height, 4, Pixels(),
      [&](std::size_t begin, std::size_t end) {
        Pixels found;
        for (std::size_t i = begin * width; i < end * width; ++i) {
          const std::size_t x = i % width, y = i / width;
          if ((x > 0 && differ(scene, g, i, i - 1)) || (x + 1 < width && differ(scene, g, i, i + 1)) ||
              (y > 0 && differ(scene, g, i, i - width)) || (y + 1 < height && differ(scene, g, i, i + width)))
            found.push_back(static_cast<std::uint32_t>(i));
        }
        return found;
      },
      [](Pixels& all, const Pixels& some) { all.insert(all.end(), some.begin(), some.end()); });
}

}  // namespace phos::inline splat
