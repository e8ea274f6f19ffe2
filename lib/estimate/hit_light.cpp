#include "estimate/hit_light.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/random.h"
#include "core/sampling.h"
#include "direct/image_sampler.h"
#include "direct/lamp_sampler.h"
#include "direct/lamp_sequence.h"
#include "estimate/events.h"
#include "radiance/tree.h"
#include "record/far_records.h"
#include "record/tree.h"
#include "scene/material/bsdf.h"
#include "scene/material/passage.h"
#include "scene/mirror/images.h"
#include "scene/texture/texture.h"

namespace phos::inline estimate {
namespace {

// Walks over gloss and mirrors end by Russian roulette from this reflection on.
constexpr std::uint32_t kRouletteFrom = 2;
constexpr float kMostSurvival = 0.999f;
constexpr std::uint32_t kMostReflections = 65534;  // of a random stream
/// Among surfaces that reflect more than they get, walks would never end. A walk is cut where its throughput
/// is above the first; above the second no place along it is followed.
constexpr float kMostThroughput = 16, kMostFollowedThroughput = 1.5f;
/// A ray's walks are cut after so many places without photons: such places lie within a body, which rays
/// enter by cracks and light does not.
constexpr std::uint32_t kMostDark = 8;
// A sheet's other side has random streams of its own: this bit numbers them.
constexpr std::uint32_t kOtherSide = 1u << 16;
// A glossy lobe is followed with at least this probability, even where mirrors reflect more.
constexpr float kLeastGloss = 0.25f;
/// A place nearer than this part of the radius of the zone that tells of its light is not read but followed.
/// Narrow mouldings beside the record share such zones with places that are lit otherwise: of 29 places about
/// those of Sponza, a million photons, irradiance was 8 % off where all is read, 1.3 % by 1/2, 1.2 % by 1 and
/// 2, 1.2 % being the noise.
constexpr double kNear = 0.5;
/// So often at most, from one such place to the next.
constexpr std::uint32_t kMostFollowed = 8;
/// One hit in so many is lit from other places too, to tell their noise.
constexpr std::uint32_t kOfWhichOneTells = 4;

/// A ray of a record's pass.
struct RayName {
  std::uint64_t item;
  std::uint32_t pass, ray;

  /// Numbers it for random streams of its own (Steele et al. 2014, SplitMix64).
  std::uint64_t key() const {
    std::uint64_t z = item + 0x9e3779b97f4a7c15u * (std::uint64_t{pass} << 32 | ray | 1u << 31);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
};

/// Noise of the light that a hemisphere's rays read from the source.
class ReadNoise {
 public:
  explicit ReadNoise(const GatherSource& source)
      : photon_lm_(source.photon_lm),
        half_zone_(source.zone_photons * source.photon_lm / (2 * std::numbers::pi)),
        common_(source.common) {}

  /// What was read along one ray.
  void add(const HitLight::Worker::Read& read, float projected_sr, float cosine) {
    told_ += static_cast<double>(projected_sr * read.told);
    told_error_ += static_cast<double>(projected_sr * read.told_error);
    const auto lux = static_cast<double>(read.lux), d = static_cast<double>(read.distance_m);
    const auto projected = static_cast<double>(projected_sr), c = static_cast<double>(cosine);
    const double spread = c * (d * d * lux + half_zone_);
    if (!(lux > 0) || !(spread > 0)) return;  // of a source without noise
    irradiance_ += projected * DVec3(read.radiance);
    const DVec3 white =
        photon_lm_ * lux * static_cast<double>(read.cosine) * projected / spread * DVec3(read.noise);
    variance_ += c * c * white, white_ += white;
  }
  SourceNoise all() const {
    const double common = told_ > 0 ? told_error_ * told_error_ / (told_ * told_) : common_;
    return {irradiance_, variance_, white_ / (2 * std::numbers::pi), common};
  }

 private:
  double photon_lm_, half_zone_;  // m2 lx
  double common_;
  double told_ = 0, told_error_ = 0;  // of the rays that tell it
  DVec3 irradiance_{0}, variance_{0}, white_{0};
};

bool positive(const Rgb& c) { return c.x > 0 || c.y > 0 || c.z > 0; }

}  // namespace

struct HitLight::Impl {
  const RayScene& rays;
  const Scene& scene;
  const Luminaires& lights;
  GatherSource source;
  std::uint64_t seed;
  std::int64_t bounces;
  LampSampler lamps;
  ImageSampler images;
  bool caustics_apart;
  bool follow_near;  // places near by are followed instead of read
  /// The facts of a material that do not depend on the point.
  struct Surface {
    bool diffuse = false;   // it has no other lobe
    bool constant = false;  // its reflectance is the same all over, but for vertex colours
    Rgb reflectance{0};
    bool straight = false;  // rays may pass straight through it
  };
  std::vector<Surface> surface;  // per material

  Impl(const RayScene& r, const Luminaires& l, const GatherSource& s, const RecordOptions& options,
       std::uint64_t own_seed)
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

  bool reads_cache(std::int64_t bounces_left) const {
    return bounces_left != 1 && (source.indirect || source.fallback);
  }
  /// Is the light of lamps' images, at a place so many reflections from the record, in no source there?
  bool lacks_images(std::int64_t bounces_left) const {
    return !images.empty() && (reads_cache(bounces_left) ? source.lacks_images : bounces_left != 1);
  }
  Rgb arriving(const ArrivingLight& light) const {
    return light.certain ? Rgb(1) : rays.transmittance(light.ray);
  }
  Rgb cached_lx(const SurfacePoint& point, std::uint64_t item, Worker& worker) const;
  Rgb reflectance(const SurfacePoint& point) const;
  static LocalDensity caustic(const CausticLight* light, const SurfacePoint& point, Worker& worker);
  bool counts_lamps_in_mirrors(std::uint32_t followed) const;
  bool is_near(const SurfacePoint& point, const Rgb& lux) const;
  double common_error(const SurfacePoint& point) const;
  Rgb indirect(const SurfacePoint& point, const Vec3& wo, const Rgb& f, const RayName& ray,
               std::uint32_t followed, Worker& worker) const;
  Rgb from_diffuse(const SurfacePoint& point, const Vec3& wo, const LampSequence& lamp_points,
                   const RayName& ray, Worker& worker) const;
  /// Where a ray ends that goes straight through panes.
  struct Landing {
    float distance_m = kInfinity;
    Vec3 normal{0};
  };
  /// A Walk.
  Rgb from_any(const Ray& start, const Rgb& throughput, const RayName& ray, std::uint32_t followed,
               Worker& worker, Landing* landing = nullptr) const;

  struct Walk;
  struct Step;
  std::optional<Rgb> recorded(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                              std::int64_t bounces_left, Worker& worker) const;
  bool choose_step(const Bsdf& bsdf, const Vec3& wo, bool follow_gloss, RandomStream& random,
                   Step& step) const;
  Rgb beyond(const SurfacePoint& point, const Step& step) const;
  Rgb gloss_of_lamp(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, float gloss_probability,
                    RandomStream& random) const;
  Rgb from_images(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, std::int64_t bounces_left,
                  bool gloss_known, RandomStream& random) const;
};

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

/// Caustic light that records do not hold; 0: they do.
LocalDensity HitLight::Impl::caustic(const CausticLight* light, const SurfacePoint& point, Worker& worker) {
  if (!light) return {};
  return light->on_surface(point.position, point.smooth_normal, worker.caustics);
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
  const Rgb apart = caustic(source.caustics, point, worker).irradiance;
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
  const std::uint32_t samples = cached && source.holds_direct ? 0 : lamps.samples();
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
  Rgb rest(0);
  if (lacks_images(bounces)) {
    RandomStream random(seed, Stage::mirror_image, ray.key());
    rest = f * images.sample(point, bounces - 1, random).lux;
  }
  return cached ? rest + indirect(point, wo, f, ray, 0, worker) : rest;
}

/// The next ray of a walk over gloss, mirrors and glass.
struct HitLight::Impl::Step {
  Vec3 direction{0};
  Rgb weight{0};
  float density = 0;            // per sr, the choice of the lobe included; 0: mirror or glass
  float gloss_probability = 0;  // with which the glossy lobes are followed
  bool taken = false;
  bool straight = false;  // through a pane: no event
  bool mirror = false;    // reflected without a lobe
};

/// Light through the glossy lobes but for the lamps', from radiance records; nothing: it is to be followed.
std::optional<Rgb> HitLight::Impl::recorded(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                                            std::int64_t bounces_left, Worker& worker) const {
  if (!source.gloss || bounces_left == 1) return {};
  const std::optional<GlossyLight> light = source.gloss->outgoing(point, wo, worker.gloss);
  if (!light) return {};
  if (light->weight > 0) {
    if (!source.gloss_caustics) return light->radiance;
    return light->radiance +
           CausticLight::gloss(caustic(source.gloss_caustics, point, worker), bsdf, wo, worker.caustics);
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

/// A walk over glossy surfaces, mirrors and glass, that at each reads lamps and cache for its Lambert part.
/// What the start's straight line sees of lamps is left out. Every other light is counted once: unbiased but
/// for the cache.
struct HitLight::Impl::Walk {
  const Impl& light;
  Worker& worker;
  const std::uint64_t item;
  const std::uint32_t followed;
  RandomStream random;
  Way way;
  Vec3 wo;
  Rgb throughput;
  std::int64_t left;
  Rgb sum{0};
  /// The last event: where the way began, and how it was chosen. None yet: the record's own.
  std::optional<SurfacePoint> from{};
  Step last{};
  /// Flat mirrors since the record, or a place that was followed: lamps have images in them there.
  std::vector<std::pair<std::uint32_t, bool>> mirrors{};
  bool by_images;
  /// So far by mirrors and glass alone: light of lamps that comes so is caustic light.
  bool mirrors_alone = true;
  const bool count_all;

  Walk(const Impl& impl, const Ray& start, const Rgb& part, const RayName& ray, std::uint32_t places,
       Worker& own_worker)
      : light(impl),
        worker(own_worker),
        item(ray.key()),
        followed(places),
        random(impl.seed, Stage::specular, item),
        way(impl.rays, start),
        wo(-start.direction),
        throughput(part),
        left(impl.bounces),
        by_images(!impl.images.empty() && (places == 0 || impl.source.lacks_images)),
        count_all(impl.counts_lamps_in_mirrors(places)) {}

  /// Does light straight from a lamp count, where the walk finds one?
  bool counts_lamps() const { return from && (count_all || !mirrors_alone); }
  /// Have lamps an image in the mirrors of the walk, so that their light there is told already?
  bool told_by_image() const;
  void add_lambert(const SurfacePoint& at, const Vec3& towards, const Rgb& f, std::uint32_t number);
  Step shade(const SurfacePoint& point, std::uint32_t reflection);
  bool survives(std::uint32_t reflection);
  void turn(const SurfacePoint& point, const Step& step);
  void add_background();
  void add_emitted(const SurfacePoint& next);
  Rgb run(Landing* landing);
};

bool HitLight::Impl::Walk::told_by_image() const {
  if (!by_images) return false;
  std::int32_t chain = MirrorPlanes::kNone;
  for (auto m = mirrors.rbegin(); m != mirrors.rend(); ++m) {
    chain = light.lights.mirrors().follow(chain, m->first, m->second);
    if (chain == MirrorPlanes::kNone) return false;
  }
  return true;
}

/// Light of the cache and of lamps, through a diffuse lobe f.
void HitLight::Impl::Walk::add_lambert(const SurfacePoint& at, const Vec3& towards, const Rgb& f,
                                       std::uint32_t number) {
  const bool cached = light.reads_cache(left);
  if (cached) sum += light.indirect(at, towards, f, {item, followed, number}, followed, worker);
  if (cached && light.source.holds_direct) return;
  ArrivingLight arriving;
  light.lamps.sample(at, {random.uniform(), random.uniform(), random.uniform()}, arriving);
  if (positive(arriving.lux)) sum += f * arriving.lux * light.arriving(arriving);
}

/// Adds the light at a point that is read there; the step chosen there.
HitLight::Impl::Step HitLight::Impl::Walk::shade(const SurfacePoint& point, std::uint32_t reflection) {
  Bsdf bsdf = way.bsdf(point);
  Step step;
  const std::optional<Rgb> gloss =
      bsdf.has_gloss() ? light.recorded(point, bsdf, wo, left, worker) : std::nullopt;
  if (gloss)
    sum += throughput * *gloss;
  else
    bsdf.look_from(wo);
  light.choose_step(bsdf, wo, bsdf.has_gloss() && !gloss, random, step);
  if (bsdf.has_diffuse()) add_lambert(point, wo, throughput * bsdf.diffuse_reflectance() / kPi, reflection);
  if (bsdf.transmits_diffusely()) {
    const SurfacePoint there = point.other_side();
    add_lambert(there, -wo, throughput * bsdf.diffuse_transmittance() / kPi, reflection | kOtherSide);
    sum += throughput * light.from_images(there, bsdf.other_side(), -wo, left, false, random);
  }
  if (bsdf.has_gloss())
    sum += throughput * light.gloss_of_lamp(point, bsdf, wo, step.gloss_probability, random);
  sum += throughput * light.from_images(point, bsdf, wo, left, gloss.has_value(), random);
  return step;
}

/// Russian roulette, after a reflection.
bool HitLight::Impl::Walk::survives(std::uint32_t reflection) {
  if (reflection + 1 < kRouletteFrom) return true;
  const float survival = std::min(kMostSurvival, max_component(glm::abs(throughput)));
  if (!(random.uniform() < survival)) return false;
  throughput /= survival;
  return true;
}

/// Begins a new way, by an event.
void HitLight::Impl::Walk::turn(const SurfacePoint& point, const Step& step) {
  by_images = by_images && step.mirror;
  if (by_images) mirrors.emplace_back(point.triangle, point.front);
  from = point, last = step;
  mirrors_alone = mirrors_alone && !(step.density > 0);
  way = Way(light.rays, {point.leave(step.direction), step.direction});
  wo = -step.direction;
}

/// Light of the environment, where the walk leaves the scene.
void HitLight::Impl::Walk::add_background() {
  if (!counts_lamps()) return;
  sum += throughput * light.beyond(*from, last);
  if (told_by_image()) sum -= throughput * sun_luminance(light.scene, -wo);
}

/// Light of a lamp that the walk finds, weighted against gloss_of_lamp().
void HitLight::Impl::Walk::add_emitted(const SurfacePoint& next) {
  const Rgb emitted = counts_lamps() ? emitted_luminance(light.scene, next, wo) : Rgb(0);
  const std::int32_t lamp = positive(emitted) ? light.lights.light_of(next.triangle) : -1;
  if (lamp < 0 || told_by_image()) return;
  float weight = 1;
  if (last.density > 0) {
    const auto i = static_cast<std::size_t>(lamp);
    const float cos_light = std::fabs(glm::dot(next.geometric_normal, last.direction));
    const float other = light.lamps.probability(*from, i) *
                        light.lights.density(i, from->position, next.triangle, next.distance_m, cos_light);
    weight = last.density / (last.density + other);
  }
  sum += throughput * emitted * weight;
}

Rgb HitLight::Impl::Walk::run(Landing* landing) {
  SurfacePoint point;
  if (!way.next(point)) return Rgb(0);
  for (std::uint32_t reflection = 0;; ++reflection) {
    if (landing && !from) landing->distance_m = point.distance_m, landing->normal = point.geometric_normal;
    random.start_bounce(reflection);
    const Step step = shade(point, reflection);
    if (!step.taken) break;
    throughput *= step.weight;
    if (!survives(reflection)) break;
    if (!step.straight) turn(point, step);
    SurfacePoint next;
    if (!way.next(next)) {
      add_background();
      if (landing && !from) landing->distance_m = kInfinity, landing->normal = wo;
      break;
    }
    add_emitted(next);
    if (!step.straight) {
      if (left == 1) break;
      if (left > 0) --left;
    }
    if (reflection == kMostReflections || worker.dark >= kMostDark ||
        max_component(glm::abs(throughput)) > kMostThroughput) {
      worker.counters.count(kPathsCutEvent);
      break;
    }
    point = next;
  }
  return sum;
}

Rgb HitLight::Impl::from_any(const Ray& start, const Rgb& throughput, const RayName& ray,
                             std::uint32_t followed, Worker& worker, Landing* landing) const {
  return Walk(*this, start, throughput, ray, followed, worker).run(landing);
}

HitLight::HitLight(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
                   const RecordOptions& resolved, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(rays, lights, source, resolved, seed)) {}
HitLight::~HitLight() = default;

std::unique_ptr<HitLight::Worker> HitLight::make_worker() const { return std::make_unique<Worker>(); }

bool HitLight::is_diffuse(std::uint32_t material) const { return impl_->surface[material].diffuse; }

void HitLight::shade(const Vec3& origin, std::span<const Hit> hits, std::uint64_t item, std::uint32_t pass,
                     Hemisphere& h, Worker& worker) const {
  PHOS_CHECK(hits.size() == h.size() && pass < 0xffff, hits.size(), " hits of ", h.size(), " rays, pass ",
             pass);
  RandomStream random(impl_->seed, Stage::direct_light, item);
  random.start_bounce(1 + pass);
  const LampSequence lamp_points(random, impl_->lamps.samples());
  const std::size_t most_sights = impl_->lamps.samples() * hits.size();
  if (worker.sights.size() < most_sights) worker.sights.resize(most_sights);
  worker.sight_count = 0;
  worker.tell_noise = h.stratified();
  worker.other_light.clear();
  ReadNoise noise(impl_->source);
  h.lamps = {};
  for (std::size_t i = 0; i < hits.size(); ++i) {
    impl_->rays.ask_ahead(hits, i);
    h.distance_m[i] = hits[i].distance_m;
    h.radiance[i] = Rgb(0);
    h.hit_normal[i] = -h.direction[i];
    if (!std::isfinite(hits[i].distance_m)) continue;
    const SurfacePoint point = impl_->rays.surface({origin, h.direction[i]}, hits[i]);
    h.hit_normal[i] = point.geometric_normal;
    if (impl_->bounces == 0) continue;
    const RayName ray{item, pass, static_cast<std::uint32_t>(i)};
    worker.read = {}, worker.dark = 0;
    Impl::Landing landing;
    h.radiance[i] = impl_->surface[point.material].diffuse
                        ? impl_->from_diffuse(point, -h.direction[i], lamp_points, ray, worker)
                        : impl_->from_any({origin, h.direction[i]}, Rgb(1), ray, 0, worker, &landing);
    if (impl_->surface[point.material].straight)
      h.distance_m[i] = landing.distance_m, h.hit_normal[i] = landing.normal;
    if (impl_->source.photon_lm > 0)
      noise.add(worker.read, h.projected_sr[i], glm::dot(h.direction[i], h.frame.z));
  }
  h.source = noise.all();
  for (LampSight& sight : std::span(worker.sights).first(worker.sight_count)) {
    const Rgb radiance = sight.brdf * sight.light.lux;
    sight.arrived = impl_->arriving(sight.light);
    if (positive(sight.arrived))
      h.radiance[sight.hit] += sight.arrived * radiance;
    else
      worker.hidden_radiance += radiance, ++worker.hidden;
  }
  for (const Worker::OtherLight& other : worker.other_light) {
    // Where something is in the way, shadows make their noise, which even places take less of.
    Rgb radiance(0);
    bool arrived = true;
    for (const LampSight& sight : std::span(worker.sights).subspan(other.first, other.count)) {
      radiance += sight.brdf * sight.light.lux;
      arrived = arrived && sight.arrived == Rgb(1);
    }
    if (arrived) h.lamps.add(radiance - other.radiance, kOfWhichOneTells);
  }
  if (worker.without_record > 0) worker.counters.count(kWithoutRecordEvent, worker.without_record);
  if (worker.beyond_reach > 0) worker.counters.count(kBeyondReachEvent, worker.beyond_reach);
  if (worker.without_radiance > 0) worker.counters.count(kWithoutRadianceEvent, worker.without_radiance);
  worker.without_record = worker.beyond_reach = worker.without_radiance = 0;
  if (worker.fallback) {
    worker.counters.merge(worker.fallback->counters);
    worker.fallback->counters = Counters();
  }
}

}  // namespace phos::inline estimate
