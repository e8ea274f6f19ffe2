#include "estimate/shading.h"

#include <algorithm>

#include "core/sampling.h"
#include "core/sequence_error.h"
#include "estimate/events.h"
#include "radiance/tree.h"
#include "record/tree.h"
#include "scene/mirror/images.h"

namespace phos::inline estimate {

namespace {

/// Rays to each lamp for which the images of all lamps in mirrors are sampled once.
constexpr int kRaysOfImageSample = 16;

/// Below this share of the eye's light a specular branch is dropped, and counted.
constexpr float kLeastThroughput = 1e-4f;
/// A glossy surface seen by way of others sends on one ray, after this many reflections or refractions with
/// this probability only (Russian roulette).
constexpr int kGlossDepth = 3;
constexpr float kGlossSurvival = 0.5f;

/// Shadow rays count this often against gloss rays, whose variance is all the heuristic knows: even points on
/// a lamp that is seen whole do better than that, and rays of a broad lobe that hit it or not should not
/// spoil it. Measured: 2 takes up to two thirds off the noise of polished floors and boxes, and adds up to a
/// quarter beside rough metal; 4 adds half and more there.
constexpr double kEvenPoints = 2;

/// Power heuristic weight of a light sample against `gloss_rays` rays of the gloss lobe.
float light_weight(int light_samples, float light_density, int gloss_rays, float gloss_density) {
  // In double: the square of a ratio is beyond the range of floats where a map shines next to nothing.
  const double l = kEvenPoints * light_samples * static_cast<double>(light_density);
  const double g = gloss_rays * static_cast<double>(gloss_density);
  return l > 0 ? static_cast<float>(1 / (1 + (g / l) * (g / l))) : 0.f;
}

/// Shadow rays to each extended lamp from a surface that a mirror or glass shows, by its share of the eye's
/// light: it is seen as sharply as surfaces seen directly.
constexpr int kManyLightSamples = 8;
int light_samples_of(float share) { return share > 0.25f ? kManyLightSamples : share > 0.03f ? 2 : 1; }

/// A ray of gloss that starts where another landed is followed with a probability of this many times its
/// weight (Russian roulette): the light of a weak coat is little beside the Lambert part's.
constexpr float kGlossChance = 2, kLeastGlossChance = 0.05f;

/// An error of this part of the light at a place does not show.
constexpr float kNoMatter = 0.01f;
/// Where one of many rays lands, caustic light is looked for with this probability: looking takes as long as
/// several rays.
constexpr float kCausticChance = 0.125f;

/// The variance of n values, from their sum and the sum of their squares: in double, for the two nearly
/// cancel where light is even.
DVec3 variance_of_mean(const DVec3& all, const DVec3& squares, int n) {
  const auto count = static_cast<double>(n);
  const DVec3 mean = all / count;
  return glm::max(squares / count - mean * mean, DVec3(0)) / (count - 1);
}

}  // namespace

Shading::Shading(const RayScene& rays, const Luminaires& lights, const RecordTree& records,
                 const ShadingOptions& options, const GlossCache* gloss, const CausticLight* caustics)
    : rays_(rays),
      lights_(lights),
      records_(records),
      far_(records),
      options_(options),
      gloss_(gloss),
      caustics_(caustics),
      lamps_(rays, lights),
      images_(rays, lights) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const bool area = lights[i].kind == Light::Kind::area;
    extent_.push_back(area ? extent_of(rays.scene(), lights[i]) : LampExtent());
  }
}

bool Shading::out_of_sight(const LampExtent& lamp, const SurfacePoint& point) const {
  const Vec3 way = lamp.centre - point.position;
  if (glm::dot(way, point.normal) < -lamp.radius_m || glm::dot(way, point.geometric_normal) < -lamp.radius_m)
    return true;
  return glm::dot(way, lamp.front) > 1e-3f * lamp.radius_m;
}

Interpolated Shading::cached(const SurfacePoint& point, ShadingLog& log) const {
  const Interpolated found = records_.interpolate(point.position, point.smooth_normal);
  if (found.weight > 0) return found;
  log.misses.push_back({point.position, point.smooth_normal});
  return far_.interpolate(point.position, point.smooth_normal);
}

LocalDensity Shading::caustic(const SurfacePoint& point, ShadingLog& log, float other_lx) const {
  if (!caustics_) return {};
  return caustics_->on_surface(point.position, point.smooth_normal, log.caustics, kNoMatter * other_lx);
}

std::optional<GlossyLight> Shading::recorded(const SurfacePoint& point, const Vec3& wo,
                                             ShadingLog& log) const {
  if (!gloss_) return {};
  std::optional<GlossyLight> light = gloss_->outgoing(point, wo, log.memory);
  if (!light || light->weight > 0) return light;
  log.gloss_misses.push_back({point.position, point.smooth_normal});
  return {};
}

DirectLight Shading::direct(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                            const SampleRange& samples, int gloss_rays, RandomStream& sequence,
                            bool environment) const {
  DirectLight sum;
  const bool shared_gloss = gloss_rays > 0 && bsdf.has_gloss();
  std::vector<DVec3> parts;  // the part of each sample in the mean: all, where there is more than one
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const bool extended = lights_[i].extended();
    const float u0 = sequence.uniform();
    const std::uint32_t shift[2] = {sequence.bits(), sequence.bits()};
    if (out_of_sight(extent_[i], point)) continue;
    if (!environment && lights_[i].kind == Light::Kind::environment) continue;
    const int n = extended ? samples.count : 1;
    Rgb mean(0);
    if (n > 1) parts.assign(static_cast<std::size_t>(n), DVec3(0));
    for (int s = 0; s < n; ++s) {
      Illumination light;
      const int k = samples.first + s;
      const float u_triangle = (static_cast<float>(k) + u0) / static_cast<float>(samples.total);
      if (!lights_.illuminate(i, point.position, std::min(u_triangle, kBelowOne),
                              sobol_point(k, shift[0], shift[1]), light))
        continue;
      const float cosine = glm::dot(point.normal, light.direction);
      if (!(cosine > 0) || !(glm::dot(point.geometric_normal, light.direction) > 0)) continue;
      if (extended && !(light.density > 0)) continue;
      const Rgb share = arriving_share(rays_, point, light);
      if (share == Rgb(0)) continue;
      const Rgb arriving = share * light.value * cosine / (extended ? light.density : 1.f);
      sum.illuminance += arriving / static_cast<float>(n);
      Rgb f = options_.cached_direct ? bsdf.evaluate_gloss(wo, light.direction)
                                     : bsdf.evaluate(wo, light.direction);
      if (extended && shared_gloss) {
        const Rgb glossy = bsdf.evaluate_gloss(wo, light.direction);
        const float w = light_weight(n, light.density, gloss_rays, bsdf.density_gloss(wo, light.direction));
        f += (w - 1.f) * glossy;
      }
      const Rgb value = f * arriving;
      mean += value;
      if (n > 1) parts[static_cast<std::size_t>(s)] = DVec3(value) / static_cast<double>(n);
    }
    sum.radiance += mean / static_cast<float>(n);
    if (n > 1)
      sum.variance +=
          sequence_variance(parts, lights_.by_u_alone(i), {PointOrder::Kind::sobol, samples.first});
  }
  return sum;
}

DirectLight Shading::mirrored(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, bool gloss_by_rays,
                              const SampleRange& samples, RandomStream& sequence) const {
  DirectLight sum;
  if (images_.empty()) return sum;
  std::vector<ImageSampler::Sample> images;
  const int n = std::max(samples.count, 1), times = std::max(n / kRaysOfImageSample, 1);
  const RandomStream start = sequence;
  for (int t = 0; t < times; ++t) {
    sequence = start;
    images_.sample_all(point, samples.first / n * times + t, samples.total / n * times, sequence, images);
    for (const ImageSampler::Sample& image : images) {
      const Rgb lux = image.lux / static_cast<float>(times);
      sum.illuminance += lux;
      sum.radiance += image_share(bsdf, wo, image, gloss_by_rays) * lux;
    }
  }
  return sum;
}

Rgb Shading::image_share(const Bsdf& bsdf, const Vec3& wo, const ImageSampler::Sample& image,
                         bool gloss_by_rays) const {
  Rgb f(0);
  if (!options_.cached_direct && bsdf.has_diffuse()) f += bsdf.diffuse_reflectance() / kPi;
  if (!gloss_by_rays || !image.extended) f += bsdf.evaluate_gloss(wo, image.direction);
  return f;
}

Rgb Shading::from_one_lamp(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, bool gloss_by_rays,
                           RandomStream& random) const {
  Rgb sum(0);
  if (!images_.empty()) {
    const ImageSampler::Sample image = images_.sample(point, -1, random);
    if (max_component(image.lux) > 0) sum += image_share(bsdf, wo, image, gloss_by_rays) * image.lux;
  }
  if (lights_.size() == 0) return sum;
  const auto n = static_cast<int>(lamps_.samples());
  const float shift = random.uniform();
  Rgb mean(0);
  for (int s = 0; s < n; ++s)
    mean += from_lamp(
        lamps_.choose(point, std::min((static_cast<float>(s) + shift) / static_cast<float>(n), kBelowOne)),
        point, bsdf, wo, gloss_by_rays, random);
  return sum + mean / static_cast<float>(n);
}

Rgb Shading::from_lamp(const LampSampler::Choice& choice, const SurfacePoint& point, const Bsdf& bsdf,
                       const Vec3& wo, bool gloss_by_rays, RandomStream& random) const {
  const Light& lamp = lights_[choice.light];
  Illumination light;
  if (!(choice.probability > 0) || out_of_sight(extent_[choice.light], point) ||
      !lights_.illuminate(choice.light, point.position, std::min(choice.rest, kBelowOne), random.uniform2(),
                          light))
    return Rgb(0);
  const float cosine = glm::dot(point.normal, light.direction);
  if (!(cosine > 0) || !(glm::dot(point.geometric_normal, light.direction) > 0)) return Rgb(0);
  if (lamp.extended() && !(light.density > 0)) return Rgb(0);
  Rgb f =
      options_.cached_direct ? bsdf.evaluate_gloss(wo, light.direction) : bsdf.evaluate(wo, light.direction);
  if (gloss_by_rays && lamp.extended())
    f -= left_to_gloss(point, choice.light, kOneLamp, light.density, 1,
                       bsdf.density_gloss(wo, light.direction)) *
         bsdf.evaluate_gloss(wo, light.direction);
  if (f == Rgb(0)) return Rgb(0);
  const Rgb arriving =
      light.value * (cosine / (choice.probability * (lamp.extended() ? light.density : 1.f)));
  return f * arriving * arriving_share(rays_, point, light);
}

float Shading::left_to_gloss(const SurfacePoint& point, std::size_t light, int light_samples,
                             float light_density, int gloss_rays, float gloss_density) const {
  if (light_samples == kOneLamp) {
    light_samples = 1;
    if (light_density > 0) light_density *= lamps_.probability(point, light);
  }
  return 1 - light_weight(light_samples, light_density, gloss_rays, gloss_density);
}

Rgb Shading::caustic_sample(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, bool gloss,
                            float other_lx, RandomStream& random, ShadingLog& log) const {
  if (!(random.uniform() < kCausticChance)) return Rgb(0);
  return caustic_light(point, bsdf, wo, gloss, other_lx, 1, log) / kCausticChance;
}

Rgb Shading::caustic_light(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, bool gloss,
                           float other_lx, int light_samples, ShadingLog& log) const {
  const LocalDensity bright = light_samples < kManyLightSamples
                                  ? caustics_->on_surface(point.position, point.smooth_normal,
                                                          kGatherCaustics, log.caustics, kNoMatter * other_lx)
                                  : caustic(point, log, other_lx);
  Rgb light = bright.irradiance * bsdf.diffuse_reflectance() / kPi;
  if (gloss) light += CausticLight::gloss(bright, bsdf, wo, log.caustics);
  return light;
}

GlossLight Shading::gloss(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                          const SampleRange& samples, int light_samples, int depth, RandomStream& sequence,
                          RandomStream& random, ShadingLog& log, bool environment) const {
  GlossLight sum;
  DVec3 all(0), square(0);
  const auto count_in = [&](const DVec3& value) { all += value, square += value * value; };
  const std::uint32_t shift[2] = {sequence.bits(), sequence.bits()};
  for (int s = 0; s < samples.count; ++s) {
    BsdfSample sample;
    if (!bsdf.sample_gloss(wo, sobol_point(samples.first + s, shift[0], shift[1]), sample)) continue;
    if (light_samples == kOneLamp) {
      const float chance = std::max(kGlossChance * max_component(glm::abs(sample.weight)), kLeastGlossChance);
      if (chance < 1 && !(random.uniform() < chance)) continue;
      sample.weight /= std::min(chance, 1.f);
    }
    SurfacePoint hit;
    const Ray ray{point.leave(sample.direction), sample.direction};
    if (!trace(rays_, ray, hit)) {
      if (!environment) continue;
      const float density = lights_.density_beyond(point.position, sample.direction);
      const Rgb from_beyond = sample.weight * background_luminance(rays_.scene(), sample.direction) *
                              left_to_gloss(point, static_cast<std::size_t>(lights_.environment()),
                                            light_samples, density, samples.count, sample.density);
      sum.from_lamps += from_beyond;
      count_in(DVec3(from_beyond));
      continue;
    }
    Rgb from_lamp(0);
    const Rgb lamp = emitted_luminance(rays_.scene(), hit, -sample.direction);
    const std::int32_t light = max_component(lamp) > 0 ? lights_.light_of(hit.triangle) : -1;
    if (light >= 0) {
      const float cos_light = std::fabs(glm::dot(hit.geometric_normal, sample.direction));
      const float density = lights_.density(static_cast<std::size_t>(light), point.position, hit.triangle,
                                            hit.distance_m, cos_light);
      from_lamp = sample.weight * lamp *
                  left_to_gloss(point, static_cast<std::size_t>(light), light_samples, density, samples.count,
                                sample.density);
    }
    const Rgb rest =
        sample.weight * outgoing(hit, -sample.direction, depth + 1, sample.weight, 1, random, log);
    sum.from_lamps += from_lamp;
    sum.radiance += rest;
    count_in(DVec3(from_lamp + rest));
  }
  const auto count = static_cast<float>(std::max(samples.count, 1));
  sum.from_lamps /= count;
  sum.radiance /= count;
  if (samples.count > 1) sum.variance = variance_of_mean(all, square, samples.count);
  return sum;
}

Rgb Shading::specular(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, int depth,
                      const Rgb& throughput, bool of_many, RandomStream& random, ShadingLog& log) const {
  if (!bsdf.has_specular()) return Rgb(0);
  BsdfSample branch[2];
  const int branches = bsdf.specular_branches(wo, branch);
  Rgb sum(0);
  int first = 0, end = branches;
  if (of_many && branches == 2) {
    const float all = luminance(branch[0].weight) + luminance(branch[1].weight);
    if (!(all > 0)) return sum;
    first = random.uniform() * all < luminance(branch[0].weight) ? 0 : 1, end = first + 1;
    branch[first].weight *= all / luminance(branch[first].weight);
  }
  for (int b = first; b < end; ++b) {
    const Rgb carried = throughput * branch[b].weight;
    if (depth >= options_.specular_depth || max_component(glm::abs(carried)) < kLeastThroughput) {
      log.counters.count(kSpecularPathsCutEvent);
      continue;
    }
    SurfacePoint hit;
    const Ray ray{point.leave(branch[b].direction), branch[b].direction};
    if (!trace(rays_, ray, hit)) {
      sum += branch[b].weight * background_luminance(rays_.scene(), branch[b].direction);
      continue;
    }
    sum += branch[b].weight *
           (emitted_luminance(rays_.scene(), hit, -branch[b].direction) +
            outgoing(hit, -branch[b].direction, depth + 1, carried,
                     of_many ? 1 : light_samples_of(max_component(glm::abs(carried))), random, log));
  }
  return sum;
}

Shading::Through Shading::through(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                                  const SampleRange& samples, RandomStream& sequence, ShadingLog& log) const {
  const SurfacePoint there = point.other_side();
  const Bsdf lambert = bsdf.other_side();
  const Rgb f = lambert.diffuse_reflectance() / kPi;
  Through light;
  const std::size_t misses = log.misses.size();
  const Interpolated found = cached(there, log);
  light.missed = log.misses.size() > misses;
  if (found.weight > 0) light.indirect = found.irradiance * f, light.indirect_stderr = found.stderr_lx * f;
  if (caustics_) {
    const LocalDensity bright = caustic(there, log);
    light.indirect += bright.irradiance * f;
    light.indirect_stderr = glm::sqrt(light.indirect_stderr * light.indirect_stderr +
                                      bright.stderr_lx() * f * bright.stderr_lx() * f);
  }
  if (options_.cached_direct || !options_.reflect_direct) return light;
  light.direct = direct(there, lambert, -wo, samples, 0, sequence);
  light.direct.radiance += mirrored(there, lambert, -wo, false, samples, sequence).radiance;
  return light;
}

Rgb Shading::outgoing(const SurfacePoint& point, const Vec3& wo, int depth, const Rgb& throughput,
                      int light_samples, RandomStream& random, ShadingLog& log) const {
  Bsdf bsdf(rays_.scene(), point);
  Rgb light(0);
  const bool glossy = bsdf.has_gloss();
  const std::optional<GlossyLight> known = glossy ? recorded(point, wo, log) : std::nullopt;
  const bool by_rays = glossy && !known;
  if (by_rays) bsdf.look_from(wo);
  float lux = 0;  // from the cache
  if (bsdf.has_diffuse()) {
    const Interpolated found = cached(point, log);
    lux = luminance(found.irradiance);
    if (found.weight > 0) light += found.irradiance * bsdf.diffuse_reflectance() / kPi;
  }
  if (known) light += known->radiance;
  const bool of_many = light_samples == 1;  // rays, over which its light is averaged
  const bool lit = options_.reflect_direct && (glossy || (bsdf.has_diffuse() && !options_.cached_direct));
  if (lit && of_many) {
    light += from_one_lamp(point, bsdf, wo, by_rays, random);
  } else if (lit) {
    const DirectLight straight = direct(point, bsdf, wo, light_samples, by_rays ? light_samples : 0, random);
    light += straight.radiance + mirrored(point, bsdf, wo, by_rays, 1, random).radiance;
    if (!options_.cached_direct) lux += luminance(straight.illuminance);
  }
  if (caustics_ && (bsdf.has_diffuse() || known))
    light += of_many ? caustic_sample(point, bsdf, wo, known.has_value(), lux, random, log)
                     : caustic_light(point, bsdf, wo, known.has_value(), lux, light_samples, log);
  if (bsdf.transmits_diffusely()) {
    const Through behind = through(point, bsdf, wo, light_samples, random, log);
    light += behind.indirect + behind.direct.radiance;
  }
  const float survival = depth < kGlossDepth ? 1.f : kGlossSurvival;
  if (by_rays && (survival == 1 || random.uniform() < survival)) {
    const GlossLight arriving = gloss(point, bsdf, wo, of_many ? 1 : light_samples,
                                      of_many ? kOneLamp : light_samples, depth, random, random, log);
    light += arriving.radiance / survival;
    if (options_.reflect_direct) light += arriving.from_lamps / survival;
  }
  return light + specular(point, bsdf, wo, depth, throughput, of_many, random, log);
}

}  // namespace phos::inline estimate
