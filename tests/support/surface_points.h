// Random points on the surfaces of a scene, and the share of these points that is covered.
#pragma once

#include <algorithm>
#include <vector>

#include "core/random.h"
#include "core/sampling.h"
#include "record/irradiance_cache.h"
#include "record/tree.h"
#include "scene/rays.h"

namespace phos::test {

/// Point of one side of a triangle.
inline SurfacePoint surface_point(const RayScene& rays, std::uint32_t triangle, bool back, const Vec2& uv) {
  const Vec3 n = geometric_normal(rays.scene(), triangle);
  return rays.surface({Vec3(0), back ? n : -n}, {0, triangle, uv.x, uv.y});
}

enum class Spread { by_area, by_triangle };

/// n points on either side of all triangles.
inline std::vector<SurfacePoint> surface_points(const RayScene& rays, std::size_t n, Spread spread,
                                                std::uint64_t seed = 5) {
  const Scene& scene = rays.scene();
  std::vector<double> sum;
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t) {
    const double size = spread == Spread::by_area ? static_cast<double>(area_m2(scene, t)) : 1;
    sum.push_back((sum.empty() ? 0 : sum.back()) + size);
  }
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < n; ++i) {
    RandomStream random(seed, Stage::test, i);
    const double at = random.uniform_double() * sum.back();
    const auto t = std::upper_bound(sum.begin(), sum.end() - 1, at) - sum.begin();
    const bool back = random.uniform() < 0.5f;
    points.push_back(
        surface_point(rays, static_cast<std::uint32_t>(t), back, sample_triangle(random.uniform2())));
  }
  return points;
}

/// Those of the points that a lamp at `lamp` lights, straight or from a place of the scene that it lights.
inline std::vector<SurfacePoint> lit_points(const RayScene& rays, const std::vector<SurfacePoint>& points,
                                            const Vec3& lamp) {
  const auto sees_lamp = [&](const SurfacePoint& p) {
    return glm::dot(lamp - p.position, p.geometric_normal) > 0 && rays.visible(p, lamp, 0);
  };
  std::vector<SurfacePoint> first, lit;
  for (const SurfacePoint& p : surface_points(rays, 400, Spread::by_area, 6))
    if (sees_lamp(p)) first.push_back(p);
  for (const SurfacePoint& p : points) {
    const bool reached = sees_lamp(p) || std::any_of(first.begin(), first.end(), [&](const SurfacePoint& q) {
                           const Vec3 way = q.position - p.position;
                           return glm::dot(way, p.geometric_normal) > 0 &&
                                  glm::dot(way, q.geometric_normal) < 0 && rays.visible(p, q);
                         });
    if (reached) lit.push_back(p);
  }
  return lit;
}

/// Share of the points without a valid record.
inline double share_open(const Scene& scene, const IrradianceCache& cache,
                         const std::vector<SurfacePoint>& points) {
  RecordTree tree(scene.bounds, cache.accuracy);
  for (const IrradianceRecord& r : cache.records) tree.insert(r);
  const auto open = std::count_if(points.begin(), points.end(), [&](const SurfacePoint& p) {
    return !tree.covered(p.position, p.smooth_normal);
  });
  return static_cast<double>(open) / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

}  // namespace phos::test
