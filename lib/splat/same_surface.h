// Pixels that show one surface.
#pragma once

#include <cmath>
#include <optional>

#include "splat/gbuffer.h"

namespace phos {

/// What tells one surface from another.
struct SeenSurface {
  Vec3 position, normal;
  float material;
  static SeenSurface of(const GBuffer& g, std::size_t i) {
    return {Vec3(g.position[i]), Vec3(g.normal[i]), g.albedo[i].w};
  }
};

/// Same material, normals within 6 degrees, one plane: may what shines on pixel j stand for what shines on a?
inline bool same_surface(const SeenSurface& a, const GBuffer& g, std::size_t j) {
  constexpr float kSameDirection = 0.9945f;  // cos 6 degrees
  constexpr float kSamePlane = 0.1f;         // sine of the slope at which j leaves the tangent plane of a
  if (!g.covered(j) || g.albedo[j].w != a.material) return false;
  if (glm::dot(a.normal, Vec3(g.normal[j])) < kSameDirection) return false;
  const Vec3 way = Vec3(g.position[j]) - a.position;
  return std::fabs(glm::dot(a.normal, way)) <= kSamePlane * glm::length(way);
}

/// Of a pixel and the 8 about it, the one that shows the place nearest to `a` on the same surface.
std::optional<std::size_t> nearest_alike(const SeenSurface& a, const GBuffer& g, std::size_t pixel);

}  // namespace phos
