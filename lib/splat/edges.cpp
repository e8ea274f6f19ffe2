#include "splat/edges.h"

#include <cmath>

#include "core/parallel.h"

namespace phos {
namespace {

constexpr float kSameDirection = 0.966f;  // cos 15 degrees
/// Sine of the slope at which a neighbour leaves the pixel's tangent plane. Smooth normals of a coarse mesh
/// differ from its facets by less.
constexpr float kSamePlane = 0.3f;

bool differ(const GBuffer& g, std::size_t i, std::size_t j) {
  if (g.covered(i) != g.covered(j)) return true;
  if (!g.covered(i) || g.hit[i].triangle == g.hit[j].triangle) return false;
  if (g.albedo[i].w != g.albedo[j].w) return true;
  const Vec3 a(g.normal[i]), b(g.normal[j]);
  if (glm::dot(a, b) < kSameDirection) return true;
  const Vec3 way = Vec3(g.position[j]) - Vec3(g.position[i]);
  const float off = std::fmax(std::fabs(glm::dot(a, way)), std::fabs(glm::dot(b, way)));
  return off > kSamePlane * glm::length(way);
}

}  // namespace

std::vector<std::uint32_t> edge_pixels(const GBuffer& g) {
  using Pixels = std::vector<std::uint32_t>;
  const auto width = static_cast<std::size_t>(g.width), height = static_cast<std::size_t>(g.height);
  return parallel_reduce(
      height, 4, Pixels(),
      [&](std::size_t begin, std::size_t end) {
        Pixels found;
        for (std::size_t i = begin * width; i < end * width; ++i) {
          const std::size_t x = i % width, y = i / width;
          if ((x > 0 && differ(g, i, i - 1)) || (x + 1 < width && differ(g, i, i + 1)) ||
              (y > 0 && differ(g, i, i - width)) || (y + 1 < height && differ(g, i, i + width)))
            found.push_back(static_cast<std::uint32_t>(i));
        }
        return found;
      },
      [](Pixels& all, const Pixels& some) { all.insert(all.end(), some.begin(), some.end()); });
}

}  // namespace phos
