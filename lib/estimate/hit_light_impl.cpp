#include "estimate/hit_light_impl.h"

#include <algorithm>

#include "core/random.h"
#include "core/sampling.h"
#include "estimate/events.h"
#include "estimate/hit_light_walk.h"
#include "radiance/tree.h"
#include "record/far_records.h"
#include "record/tree.h"
#include "scene/material/passage.h"
#include "scene/mirror/images.h"
#include "scene/texture/texture.h"

namespace phos::inline estimate {
namespace {

/// No place along a walk of more throughput is followed: among surfaces that reflect more than they get,
/// walks would never end.
constexpr float kMostFollowedThroughput = 1.5f;
// A glossy lobe is followed with at least this probability, even where mirrors reflect more.
constexpr float kLeastGloss = 0.25f;
/// A place nearer than this part of the radius of the zone that tells its light is not read but followed.
/// Narrow mouldings beside the record share such zones with places that are lit otherwise. At 29 places about
/// the mouldings of Sponza, by a million photons with a noise of 1.2 %, irradiance was 8 % off where all is
/// read, 1.3 % off by 1/2, and 1.2 % off by 1 and by 2.
constexpr double kNear = 0.5;
/// An error of this part of the light at a place is no matter: a record has many rays.
constexpr float kNoMatter = 0.02f;
/// So often at most, from one such place to the next.
constexpr std::uint32_t kMostFollowed = 8;

}  // namespace

HitLight::Impl::Impl(const RayScene& r, const Luminaires& l, const GatherSource& s,
                     const RecordOptions& options, std::uint64_t own_seed)
    : rays(r),
      scene(r.scene()),
      lights(l),
      source(s),
      seed(own_seed),
      bounces(options.gather_bounces),
      lamps(r, l),
      images(r, l),
      caustics_apart(options.caustics_apart) {
  for (const Material& m : scene.material) {
    surface.push_back({m.diffuse_alone(), !m.base_colour.used(), m.kd, transmits(scene, m)});
  }
  // Light of lamps that no ray finds, by way of mirrors, is in the source alone; so is light straight from
  // lamps, where it holds that.
  bool mirrors = false;
  for (std::uint32_t m = 0; m < scene.material.size(); ++m) mirrors |= Bsdf(scene, m).has_specular();
  const bool unseen = std::any_of(scene.light.begin(), scene.light.end(),
                                  [](const Light& light) { return !light.extended(); });
  follow_near = !source.holds_direct && !(mirrors && unseen);
}

Rgb HitLight::Impl::cached_lx(const SurfacePoint& point, std::uint64_t item, Worker& worker) const {
  if (source.indirect) {
    float weight;  // their error is not asked for: the error of the whole source is known
    const Rgb cached = source.indirect->irradiance(point.position, point.smooth_normal, weight);
    if (weight > 0) return cached;
    if (source.far) {
      // Photons know whether there is light at all off the planes of records.
      const auto widen = source.fallback ? RecordTree::Widen::along_plane : RecordTree::Widen::all_around;
      const Rgb beyond = source.far->irradiance(point.position, point.smooth_normal, weight, widen);
      ++worker.beyond_reach;
      if (weight > 0) return beyond;
    }
    ++worker.without_record;
  }
  if (!source.fallback) return Rgb(0);
  if (!worker.fallback) worker.fallback = source.fallback->make_worker();
  const RecordSite site{point.position, point.smooth_normal, item};
  const Rgb lux = source.fallback->irradiance_lx(site, *worker.fallback);
  worker.dark += lux == Rgb(0);
  return lux;
}

/// Caustic light that records do not hold; 0: they do. `other_lx`: light of other ways there.
LocalDensity HitLight::Impl::caustic(const CausticLight* light, const SurfacePoint& point, float other_lx,
                                     Worker& worker) {
  if (!light) return {};
  return light->on_surface(point.position, point.smooth_normal, worker.caustics, kNoMatter * other_lx);
}

/// May a walk that begins at the record, or after as many places that were followed instead of read, count
/// lamps that mirrors and glass alone show it? Not where photons tell of such light there.
bool HitLight::Impl::counts_lamps_in_mirrors(std::uint32_t followed) const {
  return followed == 0 ? !caustics_apart : !source.caustics;
}

/// Is a place that a ray found, of indirect light `lux`, to be followed, as too near for a reading there?
bool HitLight::Impl::is_near(const SurfacePoint& point, const Rgb& lux) const {
  // A zone of n photons of photon_lm each has the area n photon_lm / E.
  const double zone_lm = kNear * kNear * source.zone_photons * source.photon_lm;
  const auto distance_m = static_cast<double>(point.distance_m);
  return follow_near && kPi * distance_m * distance_m * static_cast<double>(luminance(lux)) < zone_lm;
}

/// Relative error that the light read at a place has in common with what is read elsewhere.
double HitLight::Impl::common_error(const SurfacePoint& point) const {
  Interpolated sums;
  if (source.indirect) source.indirect->add(point.position, point.smooth_normal, sums);
  const auto lux = static_cast<double>(luminance(sums.irradiance));
  if (!(lux > 0)) return std::sqrt(std::max(source.common, 0.0));
  return std::sqrt(common_part(sums.sums.shared / sums.weight)) *
         static_cast<double>(luminance(sums.stderr_lx)) / lux;
}

/// Indirect light that a diffuse lobe f sends on to wo: as it is read, or, near by, by one more ray.
Rgb HitLight::Impl::indirect(const SurfacePoint& point, const Vec3& wo, const Rgb& f, const RayName& ray,
                             std::uint32_t followed, Worker& worker) const {
  const std::uint64_t item = ray.key();
  Rgb lux = cached_lx(point, item, worker);
  const Rgb apart = caustic(source.caustics, point, luminance(lux), worker).irradiance;
  const bool cut = kPi * max_component(glm::abs(f)) > kMostFollowedThroughput || worker.dark >= kMostDark;
  if (followed == kMostFollowed || cut || !is_near(point, lux)) {
    lux += apart;
    worker.read.radiance += f * lux, worker.read.noise += f * f * lux;
    if (source.tell_common && ray.ray % kOfWhichOneTells == 0) {
      const float light = luminance(f * lux);
      worker.read.told += light;
      worker.read.told_error += light * static_cast<float>(common_error(point));
    }
    worker.read.lux = luminance(lux);
    worker.read.distance_m = point.distance_m;
    worker.read.cosine = std::fabs(glm::dot(point.geometric_normal, wo));
    return f * lux;
  }
  RandomStream random(seed, Stage::near_light, item);
  Rgb throughput = kPi * f;
  const Rgb read = f * apart;
  if (followed > 0) {
    const float survival = std::min(kMostSurvival, max_component(glm::abs(throughput)));
    if (!(random.uniform() < survival)) return read;
    throughput /= survival;
  }
  const Vec3 direction = make_frame(point.normal).to_world(sample_cosine_hemisphere(random.uniform2()));
  if (!(glm::dot(direction, point.geometric_normal) > 0)) return read;
  return read +
         from_any({point.leave(direction), direction}, throughput, {item, followed, 0}, followed + 1, worker);
}

/// Of a material that is diffuse alone.
Rgb HitLight::Impl::reflectance(const SurfacePoint& point) const {
  const Surface& own = surface[point.material];
  if (own.constant) return own.reflectance * Rgb(point.colour);
  const TextureUse& colours = scene.material[point.material].base_colour;
  return own.reflectance * Rgb(point.colour) * Rgb(look_up(scene, colours, point.uv0, point.uv1));
}

/// Light straight from a lamp that something may hide is left in worker.sights instead.
Rgb HitLight::Impl::from_diffuse(const SurfacePoint& point, const Vec3& wo, const LampSequence& lamp_points,
                                 const RayName& ray, Worker& worker) const {
  const Rgb f = reflectance(point) * (1 / kPi);
  if (!positive(f)) return Rgb(0);
  const bool cached = reads_cache(bounces);
  const bool lit = !(cached && source.holds_direct);
  const std::uint32_t samples = lit && !told ? lamps.samples() : 0;
  const std::size_t first = worker.sight_count;
  for (std::uint32_t n = 0; n < samples; ++n) {
    LampSight& sight = worker.sights[worker.sight_count];
    lamps.sample(point, lamp_points.point(ray.ray, n), sight.light);
    if (!positive(sight.light.lux)) continue;
    sight.brdf = f / static_cast<float>(samples), sight.hit = ray.ray;
    ++worker.sight_count;
  }
  if (worker.tell_noise && worker.sight_count > first && ray.ray % kOfWhichOneTells == 0) {
    Worker::OtherLight other{Rgb(0), first, worker.sight_count - first};
    for (std::uint32_t n = 0; n < samples; ++n) {
      ArrivingLight light;
      lamps.sample(point, lamp_points.other_point(ray.ray, n), light);
      other.radiance += f / static_cast<float>(samples) * light.lux;
    }
    worker.other_light.push_back(other);
  }
  Rgb rest = lit && told ? f * told->lux(point, ray.ray) : Rgb(0);
  if (lacks_images(bounces)) {
    RandomStream random(seed, Stage::mirror_image, ray.key());
    rest += f * images.sample(point, bounces - 1, random).lux;
  }
  return cached ? rest + indirect(point, wo, f, ray, 0, worker) : rest;
}

/// Light through the glossy lobes but for the lamps', from radiance records; nothing: it is to be followed.
std::optional<Rgb> HitLight::Impl::recorded(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                                            std::int64_t bounces_left, Worker& worker) const {
  if (!source.gloss || bounces_left == 1) return {};
  const std::optional<GlossyLight> light = source.gloss->outgoing(point, wo, worker.gloss);
  if (!light) return {};
  if (light->weight > 0) {
    if (!source.gloss_caustics) return light->radiance;
    return light->radiance +
           CausticLight::gloss(caustic(source.gloss_caustics, point, 0, worker), bsdf, wo, worker.caustics);
  }
  ++worker.without_radiance;
  return {};
}

/// Chooses among the glossy lobes together (with `follow_gloss`) and each mirror or refraction. False: there
/// is none of them.
bool HitLight::Impl::choose_step(const Bsdf& bsdf, const Vec3& wo, bool follow_gloss, RandomStream& random,
                                 Step& step) const {
  BsdfSample branch[2];
  const int branches = bsdf.specular_branches(wo, branch);
  float share[2] = {0, 0}, sum = 0;
  for (int b = 0; b < branches; ++b) sum += share[b] = luminance(branch[b].weight);
  float gloss = 0;
  if (follow_gloss) gloss = std::max(kLeastGloss, 1 - sum - luminance(bsdf.diffuse_reflectance()));
  sum += gloss;
  if (!(sum > 0)) return false;
  step.gloss_probability = gloss / sum;
  const float u = random.uniform();
  const Vec2 u2 = random.uniform2();
  BsdfSample sample;
  if (u * sum < gloss) {
    if (!bsdf.sample_gloss(wo, u2, sample)) return true;
    step.direction = sample.direction;
    step.weight = sample.weight / step.gloss_probability;
    step.density = sample.density * step.gloss_probability;
  } else {
    const int b = branches == 2 && u * sum - gloss >= share[0] ? 1 : 0;
    if (!(share[b] > 0)) return true;
    step.direction = branch[b].direction;
    step.weight = branch[b].weight * (sum / share[b]);
    step.straight = branch[b].straight, step.mirror = !branch[b].transmitted;
  }
  step.taken = true;
  return true;
}

/// The environment that a walk's ray from `point` sees, weighted against gloss_of_lamp().
Rgb HitLight::Impl::beyond(const SurfacePoint& point, const Step& step) const {
  const Rgb luminance = background_luminance(scene, step.direction);
  if (!positive(luminance) || !(step.density > 0) || lights.environment() < 0) return luminance;
  const float other = lamps.probability(point, static_cast<std::size_t>(lights.environment())) *
                      lights.density_beyond(point.position, step.direction);
  return luminance * (step.density / (step.density + other));
}

/// One sample of light straight from the lamps, through the glossy lobes towards wo; a sample of an area
/// light is weighted against the walk's next ray (balance heuristic, Veach 1997 ch. 9).
Rgb HitLight::Impl::gloss_of_lamp(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                                  float gloss_probability, RandomStream& random) const {
  if (lights.size() == 0) return Rgb(0);
  const LampSampler::Choice lamp = lamps.choose(point, random.uniform());
  Illumination light;
  if (!lights.illuminate(lamp.light, point.position, lamp.rest, random.uniform2(), light)) return Rgb(0);
  const Rgb f = bsdf.evaluate_gloss(wo, light.direction);
  const float cosine = glm::dot(point.normal, light.direction);
  if (f == Rgb(0) || !(cosine > 0)) return Rgb(0);
  const Rgb arrives = arriving_share(rays, point, light);
  if (arrives == Rgb(0)) return Rgb(0);
  float density = lamp.probability;
  if (light.density > 0)
    density = density * light.density + gloss_probability * bsdf.density_gloss(wo, light.direction);
  return arrives * f * light.value * (cosine / density);
}

/// One sample of the light that lamps send by flat mirrors, through the lobes for which no other strategy
/// finds it: the diffuse one where the source lacks it; the glossy ones of lamps without area, which no walk
/// finds, and of all lamps where radiance records know the rest of their light.
Rgb HitLight::Impl::from_images(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                                std::int64_t bounces_left, bool gloss_known, RandomStream& random) const {
  if (images.empty()) return Rgb(0);
  const bool diffuse = bsdf.has_diffuse() && lacks_images(bounces_left);
  if (!diffuse && !bsdf.has_gloss()) return Rgb(0);
  const ImageSampler::Sample light = images.sample(point, bounces_left - 1, random);
  if (!positive(light.lux)) return Rgb(0);
  Rgb f(0);
  if (diffuse) f += bsdf.diffuse_reflectance() / kPi;
  if (bsdf.has_gloss() && (gloss_known || !light.extended)) f += bsdf.evaluate_gloss(wo, light.direction);
  return f * light.lux;
}

Rgb HitLight::Impl::from_any(const Ray& start, const Rgb& throughput, const RayName& ray,
                             std::uint32_t followed, Worker& worker, Landing* landing) const {
  return Walk(*this, start, throughput, ray, followed, worker).run(landing);
}

}  // namespace phos::inline estimate
