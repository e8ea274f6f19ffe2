#include "place/points_on_surfaces.h"

#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "scene/receiver.h"

namespace phos::inline place {
namespace {

constexpr float kLeastFacing = 0.5f;  // cosine; shading normals differ from their triangles'
constexpr float kRoundings = 16;      // of positions: on the surface as it is
constexpr int kMostSurfaces = 16;     // looked at about a point
enum class Settled : std::uint8_t { on, moved, in_air };

Settled settle(const RayScene& rays, float within_m, SurfaceSample& sample) {
  const auto& [p, n] = sample;
  const float rounding_m = kRoundings * receiver(rays.scene(), p, n).error_m;
  const float before_m = within_m + rounding_m;
  Ray ray{p + before_m * n, -n, 0, 2 * before_m};
  std::optional<SurfacePoint> nearest;
  float least_m = kInfinity;
  for (int i = 0; i < kMostSurfaces; ++i) {
    Hit hit;
    if (!rays.intersect(ray, hit)) break;
    const SurfacePoint found = rays.surface(ray, hit);
    const float off_m = std::fabs(hit.distance_m - before_m);
    if (std::fabs(glm::dot(found.geometric_normal, n)) >= kLeastFacing && off_m < least_m)
      least_m = off_m, nearest = found;
    ray.t_min_m = std::nextafter(hit.distance_m, kInfinity);
  }
  if (!nearest) return Settled::in_air;
  if (least_m <= rounding_m) return Settled::on;
  sample.position = nearest->position;
  return Settled::moved;
}

}  // namespace

PointsOnSurfaces put_on_surfaces(const RayScene& rays, std::span<const SurfaceSample> points,
                                 float within_m) {
  std::vector<SurfaceSample> settled(points.begin(), points.end());
  std::vector<Settled> place(points.size());
  parallel_for(points.size(), 256, [&](std::size_t i) { place[i] = settle(rays, within_m, settled[i]); });
  PointsOnSurfaces result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.moved += place[i] == Settled::moved, result.in_air += place[i] == Settled::in_air;
    if (place[i] != Settled::in_air) result.points.push_back(settled[i]);
  }
  return result;
}

std::vector<SurfaceSample> require_surfaces(Tool& tool, const RayScene& rays,
                                            std::span<const SurfaceSample> points, float within_m,
                                            const std::string& path, const std::string& records,
                                            const std::string& instead) {
  PointsOnSurfaces found = put_on_surfaces(rays, points, within_m);
  tool.stat("points_in_air", found.in_air);
  if (found.in_air == 0) return std::move(found.points);
  const std::string why =
      text("no surface lies within ", shortest(within_m), " m below, as ", records, " need");
  if (found.points.empty())
    throw Error(ExitCode::bad_input, path,
                text("none of its ", points.size(), " points has a record: ", why,
                     "; put the points on surfaces, or ", instead));
  tool.warn(text(path, ": ", found.in_air, " of ", points.size(), " points are left out: ", why,
                 "; put the points on surfaces, or ", instead));
  return std::move(found.points);
}

}  // namespace phos::inline place
