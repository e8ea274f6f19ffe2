#include "direct/direct_light.h"

#include <algorithm>

#include "core/sampling.h"
#include "scene/mirror/images.h"
#include "scene/sky/environment.h"

namespace phos::inline direct {
namespace {

/// Lights whose numbers one bounce of a stream holds, and the bounces of more.
constexpr std::uint32_t kLightsOfABounce = 1 << 16, kManyLightsBounce = 256;

/// Points of the square by which a light is sampled.
class LampPoints {
 public:
  LampPoints(const Scene& scene, const Luminaires& lights, std::size_t i, PointOrder::Kind wanted,
             RandomStream& random)
      : bits_{random.bits(), random.bits()},
        shift_(Vec2(bits_[0] >> 8, bits_[1] >> 8) * 0x1p-24f),
        kind_(points_of(scene, lights, i, wanted)) {}
  Vec2 operator[](int k) const {
    return kind_ == PointOrder::Kind::sobol ? sobol_point(k, bits_[0], bits_[1]) : r2_point(k, shift_);
  }
  PointOrder::Kind kind() const { return kind_; }

 private:
  std::uint32_t bits_[2];
  Vec2 shift_;
  PointOrder::Kind kind_;
};

/// Of one light, where so many are asked for.
int count(const Light& light, int samples) { return light.extended() ? samples : std::min(samples, 1); }

/// Adds samples of the images that lamps have in flat mirrors; images that are dark or hidden are left out.
void sample_images(const RayScene& rays, const Luminaires& lights, const SurfacePoint& receiver,
                   std::span<const LightSamples> counts, PointOrder::Kind kind, RandomStream& random,
                   std::vector<LampSample>& out) {
  for (std::size_t chain = 0; chain < lights.mirrors().chains().size(); ++chain) {
    for (const auto& [i, samples] : counts) {
      if (!has_images(rays.scene(), lights[i])) continue;
      const int n = count(lights[i], samples);
      const float shift = random.uniform();
      const LampPoints points(rays.scene(), lights, i, kind, random);
      for (int k = 0; k < n; ++k) {
        Illumination light;
        const float u_triangle = (static_cast<float>(k) + shift) / static_cast<float>(n);
        if (!illuminate_by_mirrors(rays, lights, chain, i, receiver, std::min(u_triangle, kBelowOne),
                                   points[k], light))
          continue;
        const float cosine = glm::dot(receiver.normal, light.direction);
        if (!(cosine > 0) || !(glm::dot(receiver.geometric_normal, light.direction) > 0)) continue;
        const float density = light.density > 0 ? light.density * static_cast<float>(n) : 1.f;
        const bool area = lights[i].kind == Light::Kind::area;
        out.push_back({light.direction, light.distance_m, area ? light.normal : -light.direction,
                       light.value * (cosine / density), i, static_cast<std::uint32_t>(k),
                       static_cast<std::int32_t>(chain), points.kind()});
      }
    }
  }
}

/// Takes the first samples off `lamps`: all samples of one light, or of one image of a light. Adds their
/// light and its variance to the sum.
void add_group(std::span<const LampSample>& lamps, int samples, const Luminaires& lights,
               std::vector<DVec3>& part, LampSum& sum) {
  const LampSample first = lamps[0];
  const bool extended = lights[first.light].extended();
  // Those that are dark or hidden are zeros.
  part.assign(extended ? static_cast<std::size_t>(std::max(samples, 1)) : 1, DVec3(0));
  std::size_t i = 0;
  for (; i < lamps.size() && lamps[i].light == first.light && lamps[i].mirrors == first.mirrors; ++i) {
    part[lamps[i].number] = DVec3(lamps[i].irradiance);
    sum.irradiance += part[lamps[i].number];
  }
  if (extended) sum.variance += sequence_variance(part, lights.by_u_alone(first.light), {first.points, 0});
  lamps = lamps.subspan(i);
}

}  // namespace

void sample_lamps(const RayScene& rays, const Luminaires& lights, const SurfacePoint& receiver, int samples,
                  RandomStream& random, std::vector<LampSample>& out) {
  std::vector<LightSamples> of_each;
  for (std::uint32_t i = 0; i < lights.size(); ++i) of_each.push_back({i, std::max(samples, 1)});
  sample_lamps(rays, lights, receiver, of_each, PointOrder::Kind::r2, random, out);
}

void sample_lamps(const RayScene& rays, const Luminaires& lights, const SurfacePoint& receiver,
                  std::span<const LightSamples> counts, PointOrder::Kind kind, RandomStream& random,
                  std::vector<LampSample>& out) {
  out.clear();
  std::vector<Ray> way;
  std::vector<Rgb> share;
  for (const auto& [i, samples] : counts) {
    const int n = count(lights[i], samples);
    // A bounce's numbers are enough for so many.
    if (i > 0 && i % kLightsOfABounce == 0) random.start_bounce(kManyLightsBounce + i / kLightsOfABounce);
    // Drawn for every light, so that one light's samples do not depend on another light's.
    const float shift = random.uniform();
    const LampPoints points(rays.scene(), lights, i, kind, random);
    const bool area = lights[i].kind == Light::Kind::area;
    Luminaires::View view(lights, i, receiver.position);
    const std::size_t first = out.size();
    way.clear();
    for (int k = 0; k < n; ++k) {
      Illumination light;
      const float u_triangle = (static_cast<float>(k) + shift) / static_cast<float>(n);
      if (!view.illuminate(std::min(u_triangle, kBelowOne), points[k], light)) continue;
      const float cosine = glm::dot(receiver.normal, light.direction);
      if (!(cosine > 0) || !(glm::dot(receiver.geometric_normal, light.direction) > 0)) continue;
      const Rgb irradiance =
          light.value * (cosine / (light.density > 0 ? light.density * static_cast<float>(n) : 1.f));
      if (!(max_component(irradiance) > 0)) continue;
      out.push_back({light.direction, light.distance_m, area ? light.normal : -light.direction, irradiance, i,
                     static_cast<std::uint32_t>(k), -1, points.kind()});
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
  if (!lights.mirrors().empty()) sample_images(rays, lights, receiver, counts, kind, random, out);
}

PointOrder::Kind points_of(const Scene& scene, const Luminaires& lights, std::size_t i,
                           PointOrder::Kind wanted) {
  // Half of an environment's samples go to its sun (Environment::sun_chance()): Sobol' points give it just
  // half, where R2 would give it a few too many or too few.
  if (lights[i].kind == Light::Kind::environment)
    return scene.environment && scene.environment->sun() ? PointOrder::Kind::sobol : PointOrder::Kind::r2;
  return lights[i].kind == Light::Kind::area && lights.by_u_alone(i) ? wanted : PointOrder::Kind::r2;
}

LampSum sum_of(std::span<const LampSample> lamps, int samples, const Luminaires& lights) {
  LampSum sum;
  std::vector<DVec3> part;
  while (!lamps.empty()) add_group(lamps, samples, lights, part, sum);
  return sum;
}

std::vector<LampSum> sums_of(std::span<const LampSample> lamps, std::span<const LightSamples> counts,
                             const Luminaires& lights) {
  std::vector<LampSum> sums(counts.size());
  std::vector<DVec3> part;
  std::size_t k = 0;
  while (!lamps.empty()) {
    // Samples come in the order of counts; the ones of images in it again, mirror by mirror.
    while (counts[k].light != lamps[0].light) k = (k + 1) % counts.size();
    add_group(lamps, counts[k].samples, lights, part, sums[k]);
  }
  return sums;
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

}  // namespace phos::inline direct
