#include "cache/direct_light.h"

#include <algorithm>

#include "core/sampling.h"
#include "scene/environment.h"
#include "scene/mirror_images.h"

namespace phos {

SurfacePoint receiver(const Scene& scene, const Vec3& p, const Vec3& n) {
  // The bound of scene/offset.h, for the largest coordinates and the longest edge that the scene can have.
  constexpr float kRoundoff = 0x1p-24f;
  float largest = max_component(glm::abs(p));
  if (!scene.bounds.empty())
    largest = std::max(
        {largest, max_component(glm::abs(scene.bounds.lo)), max_component(glm::abs(scene.bounds.hi))});
  SurfacePoint point;
  point.position = p;
  point.geometric_normal = point.smooth_normal = point.normal = n;
  point.tangent = make_frame(n).x;
  point.error_m = kRoundoff * (16 * largest + 32 * scene.bounds.diagonal_m());
  return point;
}

namespace {

/// Half of an environment's samples go to its sun (Environment::sun_chance()): Sobol' points give it just
/// half, where R2 would give it a few too many or too few.
bool by_halves(const Scene& scene, const Light& light) {
  return light.kind == Light::Kind::environment && scene.environment && scene.environment->sun();
}

/// Adds samples of the images that lamps have in flat mirrors; what is dark or hidden is left out.
void sample_images(const RayScene& rays, const Luminaires& lights, const SurfacePoint& receiver, int samples,
                   RandomStream& random, std::vector<LampSample>& out) {
  const MirrorPlanes& mirrors = lights.mirrors();
  for (std::size_t chain = 0; chain < mirrors.chains().size(); ++chain) {
    for (std::size_t i = 0; i < lights.size(); ++i) {
      if (!has_images(rays.scene(), lights[i])) continue;
      const int n = lights[i].extended() ? std::max(samples, 1) : 1;
      const float shift = random.uniform();
      const Vec2 shift2 = random.uniform2();
      for (int k = 0; k < n; ++k) {
        Illumination light;
        const float u_triangle = (static_cast<float>(k) + shift) / static_cast<float>(n);
        if (!illuminate_by_mirrors(rays, lights, mirrors, chain, i, receiver, std::min(u_triangle, kBelowOne),
                                   r2_point(k, shift2), light))
          continue;
        const float cosine = glm::dot(receiver.normal, light.direction);
        if (!(cosine > 0) || !(glm::dot(receiver.geometric_normal, light.direction) > 0)) continue;
        const float density = light.density > 0 ? light.density * static_cast<float>(n) : 1.f;
        const bool area = lights[i].kind == Light::Kind::area;
        out.push_back({light.direction, light.distance_m, area ? light.normal : -light.direction,
                       light.value * (cosine / density), static_cast<std::uint32_t>(i),
                       static_cast<std::uint32_t>(k), static_cast<std::int32_t>(chain)});
      }
    }
  }
}

}  // namespace

void sample_lamps(const RayScene& rays, const Luminaires& lights, const SurfacePoint& receiver, int samples,
                  RandomStream& random, std::vector<LampSample>& out) {
  out.clear();
  std::vector<Ray> way;
  std::vector<Rgb> share;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const int n = lights[i].extended() ? std::max(samples, 1) : 1;
    // Drawn for every light, so that one light's samples do not depend on what another's do.
    const float shift = random.uniform();
    const std::uint32_t bits[2] = {random.bits(), random.bits()};
    const Vec2 shift2 = Vec2(bits[0] >> 8, bits[1] >> 8) * 0x1p-24f;
    const bool halves = by_halves(rays.scene(), lights[i]);
    const bool area = lights[i].kind == Light::Kind::area;
    Luminaires::View view(lights, i, receiver.position);
    const std::size_t first = out.size();
    way.clear();
    for (int k = 0; k < n; ++k) {
      Illumination light;
      const float u_triangle = (static_cast<float>(k) + shift) / static_cast<float>(n);
      const Vec2 u = halves ? sobol_point(k, bits[0], bits[1]) : r2_point(k, shift2);
      if (!view.illuminate(std::min(u_triangle, kBelowOne), u, light)) continue;
      const float cosine = glm::dot(receiver.normal, light.direction);
      if (!(cosine > 0) || !(glm::dot(receiver.geometric_normal, light.direction) > 0)) continue;
      const Rgb irradiance =
          light.value * (cosine / (light.density > 0 ? light.density * static_cast<float>(n) : 1.f));
      if (!(max_component(irradiance) > 0)) continue;
      out.push_back({light.direction, light.distance_m, area ? light.normal : -light.direction, irradiance,
                     static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k), -1,
                     halves ? PointOrder::Kind::sobol : PointOrder::Kind::r2});
      way.push_back(shadow_ray(receiver, light));
    }
    share.resize(way.size());
    rays.transmittance(way, share);
    std::size_t kept = first;
    for (std::size_t k = 0; k < way.size(); ++k) {
      LampSample sample = out[first + k];
      if (way[k].t_max_m > 0) sample.irradiance *= share[k];
      if (max_component(sample.irradiance) > 0) out[kept++] = sample;
    }
    out.resize(kept);
  }
  if (!lights.mirrors().empty()) sample_images(rays, lights, receiver, samples, random, out);
}

LampSum sum_of(std::span<const LampSample> lamps, int samples, const Luminaires& lights) {
  LampSum sum;
  std::vector<DVec3> part;
  for (std::size_t i = 0; i < lamps.size();) {
    // The samples of one light, or image, follow each other; those that are dark or hidden are zeros.
    const std::uint32_t light = lamps[i].light;
    const std::int32_t mirrors = lamps[i].mirrors;
    const PointOrder::Kind points = lamps[i].points;
    const bool extended = lights[light].extended();
    part.assign(extended ? static_cast<std::size_t>(std::max(samples, 1)) : 1, DVec3(0));
    for (; i < lamps.size() && lamps[i].light == light && lamps[i].mirrors == mirrors; ++i) {
      part[lamps[i].number] = DVec3(lamps[i].irradiance);
      sum.irradiance += part[lamps[i].number];
    }
    if (extended) sum.variance += sequence_variance(part, lights.by_u_alone(light), {points, 0});
  }
  return sum;
}

DVec3 light_of(std::span<const LampSample> lamps) {
  DVec3 sum(0);
  for (const LampSample& lamp : lamps) sum += DVec3(lamp.irradiance);
  return sum;
}

DirectIrradiance direct_irradiance(const RayScene& rays, const Luminaires& lights,
                                   const SurfacePoint& receiver, int samples, RandomStream& random) {
  std::vector<LampSample> lamps;
  sample_lamps(rays, lights, receiver, samples, random, lamps);
  const LampSum sum = sum_of(lamps, samples, lights);
  return {Rgb(sum.irradiance), Rgb(glm::sqrt(sum.variance))};
}

}  // namespace phos
