#include "estimate/hit_light_walk.h"

#include <algorithm>

#include "estimate/events.h"
#include "scene/mirror/images.h"

namespace phos::inline estimate {
namespace {

// Walks over gloss and mirrors end by Russian roulette from this reflection on.
constexpr std::uint32_t kRouletteFrom = 2;
constexpr std::uint32_t kMostReflections = 65534;  // of a random stream
/// Among surfaces that reflect more than they get, walks would never end: they are cut above this throughput.
constexpr float kMostThroughput = 16;
// The random streams of a sheet's other side: this bit numbers them.
constexpr std::uint32_t kOtherSide = 1u << 16;

}  // namespace

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
  if (light.told) {
    sum += f * light.told->lux(at, random.bits());
    return;
  }
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

}  // namespace phos::inline estimate
