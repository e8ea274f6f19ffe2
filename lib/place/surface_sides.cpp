#include "place/surface_sides.h"

#include <cmath>

#include "core/error.h"
#include "core/sampling.h"
#include "scene/material/bsdf.h"
#include "scene/material/passage.h"

namespace phos::inline place {
namespace {

constexpr int kRays = 16;  // that must all end at backs
constexpr int kCameraRays = 256;
constexpr float kTouching = 8;  // a surface this many rounding errors away lies on the point

/// Direction i of n, spread evenly over the sphere's part with z in (low, 1); turned about z by `turns`.
Vec3 spread_direction(int i, int n, float low, float turns) {
  const float z = 1 - (1 - low) * (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
  const float t = turns + static_cast<float>(i) * 0.618034f;
  return Vec3(std::sqrt(std::max(0.f, 1 - z * z)) * cos_sin(t - std::floor(t)), z);
}

}  // namespace

SurfaceSides::SurfaceSides(const RayScene& rays) : rays_(rays) {
  const Scene& scene = rays.scene();
  PHOS_CHECK(scene.triangle.size() < (std::size_t{1} << 31), scene.triangle.size(), " triangles");
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t) {
    const auto& v = scene.triangle[t].v;
    const DVec3 a(scene.position[v[0]]), b(scene.position[v[1]]), c(scene.position[v[2]]);
    area_m2_.push_back(0.5 * glm::length(glm::cross(b - a, c - a)));
    normal_.push_back(geometric_normal(scene, t));
    if (!(area_m2_.back() > 0) || normal_.back() == Vec3(0)) continue;
    if (!Bsdf(scene, point(2 * t, Vec2(1 / 3.f))).takes_light()) continue;
    sides_.push_back(2 * t), sides_.push_back(2 * t + 1);
  }
  oriented_ = !cameras_see_backs();
}

SurfacePoint SurfaceSides::point(Side side, const Vec2& uv) const {
  const Vec3& n = normal_[side / 2];
  return rays_.surface({Vec3(0), side % 2 == 0 ? -n : n}, {0, side / 2, uv.x, uv.y});
}

bool SurfaceSides::closed_off(const SurfacePoint& point) const {
  const Vec3& n = point.geometric_normal;
  if (rays_.scene().material[point.material].alpha_mode != Material::Alpha::opaque) {
    Hit hit;
    if (!rays_.intersect({point.leave(n), -n, 0, 3 * point.error_m}, hit)) return true;
  }
  return oriented_ && shut_in(point, true);
}

bool SurfaceSides::shut_in(const SurfacePoint& point, bool look_again) const {
  const Frame frame = make_frame(point.geometric_normal);
  const float turns = static_cast<float>(point.triangle % 1024) * 0.7548777f;
  for (int i = 0; i < kRays; ++i) {
    const Vec3 direction = frame.to_world(spread_direction(i, kRays, 0, turns));
    SurfacePoint seen;
    if (!trace(rays_, {point.leave(direction), direction}, seen)) return false;
    if (seen.distance_m <= kTouching * point.error_m) continue;
    if (transmits(rays_.scene(), rays_.scene().material[seen.material])) return false;
    if (seen.front && !(look_again && shut_in(seen, false))) return false;
  }
  return true;
}

bool SurfaceSides::cameras_see_backs() const {
  int fronts = 0, backs = 0;
  for (const Camera& camera : rays_.scene().camera) {
    for (int i = 0; i < kCameraRays; ++i) {
      SurfacePoint seen;
      const Ray ray{Vec3(camera.to_world[3]), spread_direction(i, kCameraRays, -1, 0)};
      if (trace(rays_, ray, seen)) ++(seen.front ? fronts : backs);
    }
  }
  return backs > fronts;
}

}  // namespace phos::inline place
