#include "splat/direct/same_surface.h"

#include <algorithm>

namespace phos::inline splat {

std::optional<std::size_t> nearest_alike(const SeenSurface& a, const GBuffer& g, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(g.width);
  const int x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
  std::optional<std::size_t> nearest;
  float least_m = kInfinity;
  for (int v = std::max(0, y - 1); v <= std::min(g.height - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(g.width - 1, x + 1); ++u) {
      const std::size_t j = static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u);
      if (!same_surface(a, g, j)) continue;
      const float distance_m = glm::distance(a.position, Vec3(g.position[j]));
      if (distance_m < least_m) least_m = distance_m, nearest = j;
    }
  }
  return nearest;
}

}  // namespace phos::inline splat
