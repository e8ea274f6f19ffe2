#include "photon/caustic_aim.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "scene/material/passage.h"
#include "scene/material/sharp_materials.h"

namespace phos::inline photon {
namespace {

/// This part of the paths goes to all mirrors and pieces of glass alike, the rest by their area: so each has
/// many, and large ones are no noisier than they must be.
constexpr double kAlike = 0.5;
/// Targets that turn as much of the light as this get as many paths as there are others.
constexpr double kMostTurned = 0.5;

double area_of(const Scene& scene, std::uint32_t triangle) {
  const auto& v = scene.triangle[triangle].v;
  const DVec3 a(scene.position[v[0]]), b(scene.position[v[1]]), c(scene.position[v[2]]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

}  // namespace

CausticAim::CausticAim(const RayScene& rays) : rays_(rays), luminaires_(rays.scene()) {
  const Scene& scene = rays.scene();
  for (std::uint32_t m = 0; m < scene.material.size(); ++m) taken_.push_back(turns_light(scene, m));
  double area = 0;
  for (const Instance& instance : scene.instance) {
    if (!takes(instance.material)) continue;
    Target target;
    for (std::uint32_t t = 0; t < instance.triangle_count; ++t) {
      const std::uint32_t triangle = instance.first_triangle + t;
      const double own = area_of(scene, triangle);
      if (!(own > 0)) continue;
      target.area_m2 += own;
      target.triangle.push_back(triangle), target.until.push_back(target.area_m2);
    }
    if (!(target.area_m2 > 0)) continue;
    area += target.area_m2;
    turned_ = std::max(turned_, turned_share(scene, instance.material));
    target_.push_back(std::move(target));
  }
  for (Target& target : target_)
    target.share = kAlike / static_cast<double>(target_.size()) + (1 - kAlike) * target.area_m2 / area;
  far_m_ = 2.002f * scene.bounds.diagonal_m();
}

std::uint64_t CausticAim::paths_for(std::uint64_t paths) const {
  const double turned = static_cast<double>(turned_);
  if (turned >= kMostTurned) return paths;
  return static_cast<std::uint64_t>(std::ceil(turned * static_cast<double>(paths)));
}

CausticAim::Start CausticAim::start(std::size_t light, RandomStream& random) const {
  Start start;
  if (target_.empty()) return start;
  const Scene& scene = rays_.scene();
  double u = random.uniform_double();
  std::size_t chosen = 0;
  while (chosen + 1 < target_.size() && u >= target_[chosen].share) u -= target_[chosen].share, ++chosen;
  const Target& target = target_[chosen];
  const double place = random.uniform_double() * target.area_m2;
  const auto found = std::upper_bound(target.until.begin(), target.until.end(), place);
  const auto row = std::min<std::size_t>(static_cast<std::size_t>(found - target.until.begin()),
                                         target.triangle.size() - 1);
  start.triangle = target.triangle[row];
  const auto& vertex = scene.triangle[start.triangle].v;
  // Uniform over the triangle (Turk 1990).
  const Vec2 uv = random.uniform2();
  const float root = std::sqrt(uv.x), b = root * (1 - uv.y), c = root * uv.y;
  const Vec3 &p0 = scene.position[vertex[0]], &p1 = scene.position[vertex[1]],
             &p2 = scene.position[vertex[2]];
  const Vec3 at = p0 + b * (p1 - p0) + c * (p2 - p0);

  const float u_light = random.uniform();
  const Vec2 u_place = random.uniform2();
  Illumination sample;
  if (!luminaires_.illuminate(light, at, u_light, u_place, sample)) return start;
  const bool extended = luminaires_[light].extended();
  if (extended && !(sample.density > 0)) return start;
  const float cosine = std::fabs(glm::dot(geometric_normal(scene, start.triangle), sample.direction));
  EmittedPhoton& photon = start.photon;
  photon.flux_lm = sample.value *
                   static_cast<float>(static_cast<double>(cosine) * target.area_m2 / target.share) /
                   (extended ? sample.density : 1.f);
  photon.from_infinity = !std::isfinite(sample.distance_m);
  photon.ray.direction = -sample.direction;
  photon.source_normal = -sample.direction;
  if (photon.from_infinity) {
    photon.ray.origin = at + far_m_ * sample.direction;
    return start;
  }
  photon.ray.origin = sample.position;
  if (sample.normal != Vec3(0)) {
    photon.source_normal = sample.normal;
    photon.ray.origin += sample.error_m * sample.normal;
  }
  return start;
}

}  // namespace phos::inline photon
