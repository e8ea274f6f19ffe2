#include "scene/lamp/probe.h"

#include <algorithm>

#include "core/sampling.h"
#include "scene/sky/environment.h"

namespace phos::inline scene {
namespace {

/// Rays from infinitely far away start this part of the bounding radius before its sphere, so that
/// surfaces that touch the sphere are not behind them.
constexpr float kBefore = 1.001f;

double grey(const Rgb& light) { return static_cast<double>(luminance(light)); }

}  // namespace

std::vector<Lamp> lamps_of(const Scene& scene) {
  std::vector<Lamp> lamps;
  for (std::size_t i = 0; i < scene.light.size(); ++i) {
    const Light& light = scene.light[i];
    const bool sun = light.kind == Light::Kind::environment && scene.environment->sun();
    if (sun) lamps.push_back({"sun", i, Lamp::Part::sun});
    if (sun && !(scene.environment->map_lx() > 0)) continue;
    lamps.push_back({light.name, i, sun ? Lamp::Part::sky : Lamp::Part::whole});
  }
  return lamps;
}

RandomStream LampProbe::stream(const Lamp& lamp, std::uint32_t number) {
  const std::uint64_t of_lamp = (std::uint64_t{lamp.light} << 1 | (lamp.part == Lamp::Part::sun)) + 1;
  return {0, Stage::pilot, of_lamp << 32 | number};
}

ProbeRay LampProbe::sample(const Lamp& lamp, RandomStream& random) const {
  random.start_bounce(0);
  const Light& light = scene_->light[lamp.light];
  ProbeRay ray;
  ray.ray.origin = light.position;
  switch (light.kind) {
    case Light::Kind::area:
      return light.fitting < 0 ? from_area(lamp.light, random) : from_opening(light, lamp.light, random);
    case Light::Kind::environment:
      return from_beyond(lamp, random);
    case Light::Kind::directional:
      return from_infinity(light.direction, grey(light.intensity), random);
    case Light::Kind::point:
      ray.ray.direction = sample_uniform_sphere(random.uniform2());
      ray.flux_lm = grey(light.flux_lm);
      return ray;
    case Light::Kind::measured:
      ray.ray.direction =
          scene_->fitting[static_cast<std::size_t>(light.fitting)].sample_direction(random.uniform2());
      ray.flux_lm = grey(light.flux_lm);
      return ray;
    case Light::Kind::spot: {
      const Vec3 local = sample_uniform_cone(random.uniform2(), static_cast<float>(light.cos_outer));
      ray.ray.direction = make_frame(light.direction).to_world(local);
      const double cone_sr = 2 * std::numbers::pi * (1 - light.cos_outer);
      ray.flux_lm = grey(light.intensity) * cone_sr *
                    static_cast<double>(spot_falloff(light, static_cast<double>(local.z)));
      return ray;
    }
  }
  return ray;
}

ProbeRay LampProbe::from_area(std::size_t i, RandomStream& random) const {
  const float u_triangle = random.uniform();
  const Vec2 u = random.uniform2(), u_direction = random.uniform2();
  const EmissionPoint point = luminaires_->sample_point(i, u_triangle, u);
  ProbeRay ray;
  if (!(point.density > 0)) return ray;
  const bool both_sides = scene_->material_of(point.triangle).double_sided;
  const Vec3 normal = both_sides && random.uniform() < 0.5f ? -point.normal : point.normal;
  const Vec3 local = sample_cosine_hemisphere(u_direction);
  ray.ray.direction = make_frame(normal).to_world(local);
  ray.ray.origin = point.position + point.error_m * normal;
  ray.flux_lm =
      (both_sides ? 2 : 1) * std::numbers::pi * grey(point.luminance) / static_cast<double>(point.density);
  ray.seen_m2 = static_cast<double>((*luminaires_)[i].area_m2 * local.z);
  return ray;
}

ProbeRay LampProbe::from_opening(const Light& light, std::size_t i, RandomStream& random) const {
  const Fitting& fitting = scene_->fitting[static_cast<std::size_t>(light.fitting)];
  ProbeRay ray;
  ray.ray.direction = fitting.sample_direction(random.uniform2());
  const float u_triangle = random.uniform();
  const EmissionPoint point =
      luminaires_->sample_seen_from(i, ray.ray.direction, u_triangle, random.uniform2());
  if (!(point.density > 0)) return ray;
  ray.ray.origin = point.position + point.error_m * point.normal;
  ray.flux_lm = grey(fitting.flux_lm());
  ray.seen_m2 = static_cast<double>(fitting.projected_area_m2(ray.ray.direction));
  return ray;
}

ProbeRay LampProbe::from_beyond(const Lamp& lamp, RandomStream& random) const {
  const Environment& map = *scene_->environment;
  ProbeRay ray;
  Vec3 towards;
  double lux = 0, seen_sr = 0;
  if (lamp.part == Lamp::Part::sun) {
    towards = map.sample_sun(random.uniform2());
    lux = grey(map.sun()->illuminance_lx), seen_sr = map.sun_sr();
  } else {
    const Environment::Sample sample = map.sample_flux(random.uniform2());
    // Rays of the sun are not this part's. Those that are have the whole of its light together.
    if (!(sample.density > 0) || (map.sun() && map.in_sun(sample.direction))) return ray;
    const double all_lx = grey(Rgb(map.integral_lx()));
    towards = sample.direction;
    lux = all_lx, seen_sr = map.map_lx() / std::max(grey(map.map_luminance(towards)), 1e-300);
  }
  if (!(lux > 0)) return ray;
  ray = scene_->portal.empty() ? from_infinity(-towards, lux, random) : from_portal(-towards, lux, random);
  ray.seen_sr = seen_sr;
  return ray;
}

ProbeRay LampProbe::from_infinity(const Vec3& direction, double lux, RandomStream& random) const {
  const float radius_m = bounding_radius_m(*scene_);
  const Frame frame = make_frame(direction);
  const Vec2 disc = radius_m * sample_disc(random.uniform2());
  ProbeRay ray;
  ray.ray.origin =
      scene_->bounds.centre() - kBefore * radius_m * frame.z + disc.x * frame.x + disc.y * frame.y;
  ray.ray.direction = direction;
  ray.flux_lm = std::numbers::pi * static_cast<double>(radius_m) * static_cast<double>(radius_m) * lux;
  return ray;
}

ProbeRay LampProbe::from_portal(const Vec3& direction, double lux, RandomStream& random) const {
  double all_m2 = 0;
  for (const Portal& p : scene_->portal) all_m2 += p.area_m2();
  double u = static_cast<double>(random.uniform()) * all_m2;
  std::size_t k = 0;
  while (k + 1 < scene_->portal.size() && u >= scene_->portal[k].area_m2())
    u -= scene_->portal[k++].area_m2();
  const Portal& portal = scene_->portal[k];
  const Vec2 place = random.uniform2();
  const Vec3 normal = normalized_or_zero(glm::cross(portal.edge[0], portal.edge[1]));
  ProbeRay ray;
  float cosine = std::fabs(glm::dot(normal, direction));
  if (portal.inwards != Vec3(0)) cosine = std::fmax(0.f, glm::dot(portal.inwards, direction));
  // From outside of all: objects before the window count.
  const float back_m = 2 * kBefore * bounding_radius_m(*scene_);
  ray.ray.origin = portal.at(portal.triangle ? sample_triangle(place) : place) - back_m * direction;
  ray.ray.direction = direction;
  ray.flux_lm = all_m2 * lux * static_cast<double>(cosine);
  return ray;
}

}  // namespace phos::inline scene
