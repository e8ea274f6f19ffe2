#include "reference/map/final_gather.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "reference/map/caustic_part.h"
#include "reference/map/visible_glow.h"

namespace phos::inline reference {
namespace {

constexpr float kBelowOne = 0x1.fffffep-1f;

/// Points of a lattice of rank 1 in [0,1)^2, jittered within its columns and shifted along them: each set is
/// stratified, and its mean unbiased.
class Strata {
 public:
  Strata(std::int64_t count, RandomStream& random)
      : per_(1 / static_cast<double>(count)), shift_(random.uniform_double()) {}
  Vec2 point(std::int64_t i, RandomStream& random) const {
    constexpr double kGolden = 0.6180339887498949;
    const auto n = static_cast<double>(i);
    const double y = shift_ + n * kGolden;
    return {std::min(kBelowOne, static_cast<float>((n + static_cast<double>(random.uniform())) * per_)),
            std::min(kBelowOne, static_cast<float>(y - std::floor(y)))};
  }

 private:
  double per_, shift_;
};

}  // namespace

FinalGather::FinalGather(const MapScene& scene, const MapOptions& options)
    : rays_(&scene.rays),
      luminaires_(&scene.luminaires),
      lamps_(scene.rays, scene.luminaires),
      discs_(scene.photons, options.photons_in_disc),
      count_(options.gather_rays) {
  PhotonMap caustics = caustic_part(scene.photons);
  if (caustics.size() == 0) return;
  caustic_map_ = std::move(caustics);
  caustic_discs_.emplace(*caustic_map_, options.photons_in_disc);
}

/// Emission on the way of a gather ray that belongs to no lamp: neither shadow rays nor photons bring it.
Rgb FinalGather::unsampled_glow(const SpecularStop& stop, const SurfacePoint* point) const {
  const Scene& scene = rays_->scene();
  if (!point) return luminaires_->environment() < 0 ? background_luminance(scene, stop.direction) : Rgb(0);
  return luminaires_->light_of(point->triangle) < 0 ? emitted_luminance(scene, *point, -stop.direction)
                                                    : Rgb(0);
}

/// Luminance that a gather ray brings.
Rgb FinalGather::landed(const SurfacePoint& from, const Vec3& direction, RandomStream& random) const {
  Rgb sum(0);
  follow_specular(
      *rays_, {from.leave(direction), direction, 0, kInfinity}, random,
      [&](const SpecularStop& stop, const SurfacePoint* point) {
        sum += stop.throughput * unsampled_glow(stop, point);
      },
      [&](const SpecularStop& stop, const SurfacePoint& point, const Bsdf& bsdf) {
        sum += stop.throughput * discs_.reflected(point, bsdf, -stop.direction).total();
      });
  return sum;
}

FinalGather::Gathered FinalGather::gather(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                                          RandomStream& random) const {
  Gathered sum;
  const Strata strata(count_, random);
  for (std::int64_t i = 0; i < count_; ++i) {
    BsdfSample ray;
    const float u_lobe = random.uniform();
    if (!bsdf.sample(wo, u_lobe, strata.point(i, random), ray) || ray.specular) continue;
    const Rgb light = ray.weight * landed(point, ray.direction, random);
    Rgb share(0);
    if (bsdf.has_gloss()) {
      const Rgb all = bsdf.evaluate(wo, ray.direction), gloss = bsdf.evaluate_gloss(wo, ray.direction);
      for (int c = 0; c < 3; ++c) share[c] = all[c] > 0 ? gloss[c] / all[c] : 0;
    }
    sum.glossy += share * light, sum.indirect += (Rgb(1) - share) * light;
  }
  const float each = 1 / static_cast<float>(count_);
  return {each * sum.indirect, each * sum.glossy};
}

MapSample FinalGather::scattered(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                                 RandomStream& random) const {
  MapSample light;
  light.sum.direct = lamps_.direct(
      point, [&](const Vec3& wi) { return bsdf.evaluate(wo, wi) * std::fabs(glm::dot(point.normal, wi)); },
      random);
  const Gathered gathered = gather(point, bsdf, wo, random);
  light.sum.indirect = gathered.indirect, light.sum.glossy = gathered.glossy;
  if (!caustic_discs_) return light;
  const DiscRadiance caustic = caustic_discs_->reflected(point, bsdf, wo);
  light.sum.indirect += caustic.direct + caustic.indirect, light.sum.glossy += caustic.glossy;
  light.noise = caustic.noise;
  return light;
}

MapSample FinalGather::luminance(const Ray& ray, RandomStream& random) const {
  MapSample sample;
  random.start_bounce(0);
  follow_specular(
      *rays_, ray, random,
      [&](const SpecularStop& stop, const SurfacePoint* point) {
        add_visible_glow(rays_->scene(), stop, point, sample.sum);
      },
      [&](const SpecularStop& stop, const SurfacePoint& point, const Bsdf& bsdf) {
        const MapSample light = scattered(point, bsdf, -stop.direction, random);
        sample.noise += stop.throughput * light.noise;
        if (stop.passed) {
          sample.sum.specular += stop.throughput * light.sum.total();
          return;
        }
        sample.sum.direct += light.sum.direct;
        sample.sum.indirect += light.sum.indirect, sample.sum.glossy += light.sum.glossy;
      });
  return sample;
}

DiscIrradiance FinalGather::irradiance(const SurfacePoint& point, RandomStream& random) const {
  random.start_bounce(0);
  DiscIrradiance light;
  if (caustic_discs_) light = caustic_discs_->irradiance(point);
  light.irradiance_lx += lamps_.direct(
      point, [&](const Vec3& wi) { return Rgb(std::max(0.f, glm::dot(point.geometric_normal, wi))); },
      random);
  const Frame frame = make_frame(point.geometric_normal);
  const Strata strata(count_, random);
  Rgb sum(0);
  for (std::int64_t i = 0; i < count_; ++i) {
    const Vec3 local = sample_cosine_hemisphere(strata.point(i, random));
    if (local.z > 0) sum += landed(point, frame.to_world(local), random);
  }
  light.irradiance_lx += kPi / static_cast<float>(count_) * sum;  // cos / density = pi
  return light;
}

std::optional<float> FinalGather::disc_radius_m(const Vec3& p) const {
  if (!caustic_discs_) return std::nullopt;
  return discs_.radius_m(p);
}

}  // namespace phos::inline reference
