#include "scene/mirror/images.h"

#include <algorithm>
#include <cmath>

#include "scene/material/passage.h"
#include "scene/sky/environment.h"

namespace phos::inline scene {
namespace {

/// A ray on its way from the receiver, back over the mirrors.
struct Unfolding {
  Ray ray;
  Rgb share{1};
  float error_m = 0;  // of where it starts
};

/// To the next mirror, and off it. False: it does not get there.
bool reflect(const RayScene& rays, const MirrorPlanes& mirrors, const MirrorPlanes::Chain& chain,
             float least_left_m, Unfolding& way, float& travelled_m) {
  const MirrorPlanes::Plane& plane = mirrors.plane(chain.plane);
  const float towards = glm::dot(way.ray.direction, plane.normal);
  if (towards == 0 || (towards < 0) != chain.front) return false;
  const float distance_m = glm::dot(plane.point - way.ray.origin, plane.normal) / towards;
  if (!(distance_m > 0) || !(distance_m < least_left_m)) return false;
  const Vec3 there = way.ray.origin + distance_m * way.ray.direction;
  for (int c = 0; c < 3; ++c)
    if (there[c] < plane.box.lo[c] - plane.slack_m || there[c] > plane.box.hi[c] + plane.slack_m)
      return false;

  way.ray.t_min_m = 0, way.ray.t_max_m = kInfinity;
  Way surfaces(rays, way.ray);
  SurfacePoint point;
  Rgb passed(1);
  while (surfaces.next(point)) {
    const Bsdf bsdf = surfaces.bsdf(point);
    if (mirrors.plane_of(point.triangle) != chain.plane) {
      passed *= bsdf.pane(-way.ray.direction).transmittance();
      if (passed == Rgb(0)) return false;
      continue;
    }
    BsdfSample branch[2];
    const int branches = bsdf.specular_branches(-way.ray.direction, branch);
    for (int b = 0; b < branches; ++b) {
      if (branch[b].transmitted) continue;
      way.share *= passed * branch[b].weight;
      way.ray = {point.leave(branch[b].direction), branch[b].direction};
      way.error_m = point.error_m;
      travelled_m += point.distance_m;
      return true;
    }
    return false;
  }
  return false;
}

}  // namespace

bool has_images(const Scene& scene, const Light& light) {
  return light.kind != Light::Kind::environment || (scene.environment && scene.environment->sun());
}

Rgb sun_luminance(const Scene& scene, const Vec3& direction) {
  const Environment* map = scene.environment.get();
  if (!map || !map->sun() || !map->in_sun(direction)) return Rgb(0);
  return map->luminance(direction) - map->map_luminance(direction);
}

bool illuminate_by_mirrors(const RayScene& rays, const Luminaires& lights, std::size_t chain,
                           std::size_t light, const SurfacePoint& from, float u_triangle, const Vec2& u,
                           Illumination& result) {
  const Scene& scene = rays.scene();
  const MirrorPlanes& mirrors = lights.mirrors();
  if (!(lights.image_promise_lx(chain, light, from) > 0)) return false;
  const std::vector<MirrorPlanes::Chain>& chains = mirrors.chains();
  const Vec3 image = mirrors.image(static_cast<std::int32_t>(chain), from.position);
  if (lights[light].kind == Light::Kind::environment) {
    result = Illumination();
    result.direction = scene.environment->sample_sun(u);
    result.value = sun_luminance(scene, result.direction);
    result.density = static_cast<float>(1 / scene.environment->sun_sr());
  } else if (!lights.illuminate(light, image, u_triangle, u, result)) {
    return false;
  }
  std::vector<std::int32_t> links;
  for (auto c = static_cast<std::int32_t>(chain); c != MirrorPlanes::kNone;
       c = chains[static_cast<std::size_t>(c)].before)
    links.push_back(c);
  const Vec3 direction = mirrors.image_of_direction(static_cast<std::int32_t>(chain), result.direction),
             normal = mirrors.image_of_direction(static_cast<std::int32_t>(chain), result.normal);

  Unfolding way{{from.leave(direction), direction}, Rgb(1), from.error_m};
  float travelled_m = 0;
  for (const std::int32_t c : links)
    if (!reflect(rays, mirrors, chains[static_cast<std::size_t>(c)], result.distance_m - travelled_m, way,
                 travelled_m))
      return false;
  if (std::isfinite(result.distance_m)) {
    const Vec3 rest = result.position - way.ray.origin;
    way.ray.direction = normalized_or_zero(rest);
    way.ray.t_max_m = glm::dot(rest, way.ray.direction) - std::max(result.error_m, way.error_m);
  }
  way.share *= arriving_share(rays, way.ray);
  if (!(max_component(way.share) > 0)) return false;
  result.value *= way.share;
  result.direction = direction;
  result.position = from.position + (std::isfinite(result.distance_m) ? result.distance_m : 0.f) * direction;
  result.normal = normal;
  return true;
}

}  // namespace phos::inline scene
