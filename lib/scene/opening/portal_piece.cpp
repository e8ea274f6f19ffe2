#include "scene/opening/portal_piece.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"

namespace phos::inline scene {
namespace {

Vec3 corner_of(const Portal& p, int k) { return p.at(Vec2(k == 1 || k == 3, k >= 2)); }

}  // namespace

PortalPiece::PortalPiece(const Portal& p)
    : portal(p),
      normal(glm::normalize(glm::cross(DVec3(p.edge[0]), DVec3(p.edge[1])))),
      middle(p.at(Vec2(p.triangle ? 1.f / 3 : 0.5f))),
      area_m2(static_cast<float>(p.area_m2())) {
  float radius_m = 0;
  for (int k = 0; k < (p.triangle ? 3 : 4); ++k)
    radius_m = std::max(radius_m, glm::length(corner_of(p, k) - middle));
  near2_m2 = kNearRadii * radius_m * (kNearRadii * radius_m);
}

float PortalPiece::before_m(const Vec3& from) const {
  const float height_m = glm::dot(from - portal.corner, portal.inwards == Vec3(0) ? normal : portal.inwards);
  return portal.inwards == Vec3(0) ? std::fabs(height_m) : height_m;
}

float PortalPiece::behind_m(const Vec3& from) const {
  const float height_m = before_m(from);
  return portal.inwards == Vec3(0) ? height_m : -height_m;
}

SphericalPatch PortalPiece::seen(const Vec3& from) const {
  const Vec3 corner[] = {corner_of(portal, 0), corner_of(portal, 1), corner_of(portal, 2)};
  return portal.triangle ? SphericalPatch(corner, from) : SphericalPatch(corner, corner_of(portal, 3), from);
}

bool PortalPiece::is_near(const Vec3& from) const {
  const Vec3 way = middle - from;
  return glm::dot(way, way) < near2_m2;
}

Vec3 PortalPiece::sample(const Vec3& from, const Vec2& u) const {
  if (is_near(from)) {
    const SphericalPatch patch = seen(from);
    if (patch.solid_angle_sr() > kLeastNear_sr) {
      const SphericalPatch::Place at = patch.sample(u);
      return portal.at(at.second ? Vec2(at.weights.x + at.weights.y, 1 - at.weights.x) : at.weights);
    }
  }
  return portal.at(portal.triangle ? sample_triangle(u) : u);
}

double PortalPiece::density(const Vec3& from, const Vec3& direction) const {
  if (is_near(from)) {
    const double sr = seen(from).solid_angle_sr();
    if (sr > kLeastNear_sr) return 1 / sr;
  }
  const double height_m = std::fabs(glm::dot(DVec3(portal.corner) - DVec3(from), DVec3(normal)));
  const double cosine = std::fabs(glm::dot(DVec3(direction), DVec3(normal)));
  const double distance_m = height_m / cosine;
  return distance_m * distance_m / (cosine * static_cast<double>(area_m2));
}

}  // namespace phos::inline scene
