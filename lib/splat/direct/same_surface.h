// Pixels that show one surface.
#pragma once

#include <cmath>
#include <optional>

#include "splat/gbuffer.h"

namespace phos::inline splat {

/// What tells one surface from another.
struct SeenSurface {
  Vec3 position, normal;
  float material;
  static SeenSurface of(const GBuffer& g, std::size_t i) {
    return {Vec3(g.position[i]), Vec3(g.normal[i]), g.albedo[i].w};
  }
  static SeenSurface of(const SurfacePoint& p) {
    return {p.position, p.smooth_normal, static_cast<float>(p.material)};
  }
};

/// Same material, normals within 6 degrees, one plane: may the light on b stand for the light on a?
inline bool same_surface(const SeenSurface& a, const SeenSurface& b) {
  constexpr float kSameDirection = 0.9945f;  // cos 6 degrees
  constexpr float kSamePlane = 0.1f;         // sine of the slope at which b leaves the tangent plane of a
  if (a.material != b.material || glm::dot(a.normal, b.normal) < kSameDirection) return false;
  const Vec3 way = b.position - a.position;
  return std::fabs(glm::dot(a.normal, way)) <= kSamePlane * glm::length(way);
}

/// The same for the surface that pixel j shows, if any.
inline bool same_surface(const SeenSurface& a, const GBuffer& g, std::size_t j) {
  return g.covered(j) && same_surface(a, SeenSurface::of(g, j));
}

/// Of a pixel and the 8 about it, the one that shows the place nearest to `a` on the same surface.
std::optional<std::size_t> nearest_alike(const SeenSurface& a, const GBuffer& g, std::size_t pixel);

}  // namespace phos::inline splat
