#include "reference/eye_path_tracer.h"

#include <algorithm>

#include "core/sampling.h"
#include "reference/limits.h"
#include "reference/roulette.h"
#include "scene/material/bsdf.h"
#include "scene/material/passage.h"
#include "scene/material/total_reflections.h"
#include "scene/mirror/images.h"
#include "scene/sky/environment.h"

namespace phos::inline reference {

namespace {

// The first scattering decides most of a picture's noise: there, up to so many lights are sampled one by one.
constexpr std::size_t kEveryLightUpTo = 8;
// One-light choice: no light falls below this part of an equal share, so that a lamp close by is not starved.
constexpr double kMinimumShare = 0.1;

/// Power heuristic with exponent 2 (Veach 1997, eq. 9.13), from the ratio so that squares do not overflow.
float power_weight(float own, float other) {
  const float ratio = other / own;
  return 1 / (1 + ratio * ratio);
}

bool positive(const Rgb& c) { return max_component(c) > 0; }

}  // namespace

/// A path on its way: the next ray, and the weight of the light found along it.
struct EyePathTracer::Walk {
  Ray ray;
  Vec3 from{0};  // where the ray was chosen, before it was lifted off the surface
  Rgb throughput{1};
  float density = 0;         // of the ray's direction, per sr; 0: camera ray or specular, which next-event
                             // estimation cannot make
  bool every_light = false;  // how next-event estimation chose where the ray started
  // Flat mirrors since the last event that was none: images of lamps are sampled from there too.
  struct Mirror {
    std::uint32_t triangle;
    bool front;
  };
  std::vector<Mirror> mirrors;
  float density_before =
      0;                  // of the ray that left that event; 0: no event, or light has gone another way since
  float travelled_m = 0;  // from there to where the ray starts
  bool mirrored = false;  // the visible surface is a mirror or glass
  Rgb glossy{0};          // share of the path's light that the visible surface's gloss reflects
  std::int64_t scatterings = 0;
  std::int64_t events = 0;  // scatterings and panes passed: numbers the random draws
  TotalReflections total_reflections;
};

EyePathTracer::EyePathTracer(const RayScene& rays, const Luminaires& luminaires, const PathOptions& options)
    : rays_(&rays), luminaires_(&luminaires), options_(options) {
  double sum = 0;
  for (const double share :
       luminaires.size() > 0 ? luminaires.power_shares(kMinimumShare) : std::vector<double>{}) {
    share_.push_back(static_cast<float>(share));
    cdf_.push_back(sum += share);
  }
}

bool EyePathTracer::sample_every_light(std::int64_t scatterings) const {
  return luminaires_->size() == 1 || (scatterings == 0 && luminaires_->size() <= kEveryLightUpTo);
}

/// Next-event estimation: light straight from the lights, scattered at `point`. scatter(direction, density)
/// returns f cos and sets the density, per sr, with which the path's own sampling would choose that
/// direction.
template <class Scatter>
Rgb EyePathTracer::light_at(const SurfacePoint& point, bool every_light, const Scatter& scatter,
                            RandomStream& random) const {
  Rgb sum(0);
  const auto add_straight = [&](std::size_t i, float probability) {
    Illumination light;
    const float u_triangle = random.uniform();
    if (!luminaires_->illuminate(i, point.position, u_triangle, random.uniform2(), light)) return;
    float scatter_density = 0;
    const Rgb f_cos = scatter(light.direction, scatter_density);
    if (!positive(f_cos)) return;
    const Rgb share = arriving_share(*rays_, point, light);
    if (!positive(share)) return;
    const float density = light.density * probability;
    if (light.density > 0)
      sum += share * f_cos * light.value * (power_weight(density, scatter_density) / density);
    else
      sum += share * f_cos * light.value / probability;
  };
  const auto add = [&](std::size_t i, float probability) {
    add_straight(i, probability);
    if (!has_images(rays_->scene(), (*luminaires_)[i])) return;
    for (std::size_t chain = 0; chain < luminaires_->mirrors().chains().size(); ++chain) {
      Illumination light;
      const float u_triangle = random.uniform();
      if (!illuminate_by_mirrors(*rays_, *luminaires_, chain, i, point, u_triangle, random.uniform2(), light))
        continue;
      float scatter_density = 0;
      const Rgb f_cos = scatter(light.direction, scatter_density);
      if (!positive(f_cos)) continue;
      const float density = light.density * probability;
      sum += f_cos * light.value *
             (light.density > 0 ? power_weight(density, scatter_density) / density : 1 / probability);
    }
  };
  if (every_light) {
    for (std::size_t i = 0; i < share_.size(); ++i) add(i, 1);
  } else if (!share_.empty()) {
    const double u = random.uniform() * cdf_.back();
    const auto i = static_cast<std::size_t>(std::upper_bound(cdf_.begin(), cdf_.end() - 1, u) - cdf_.begin());
    if (share_[i] > 0) add(i, share_[i]);
  }
  return sum;
}

/// Luminance that `point` sends back along the walk's ray, weighted against next-event estimation where the
/// ray began.
Rgb EyePathTracer::emission_at(const SurfacePoint& point, const Walk& walk) const {
  const Rgb luminance = emitted_luminance(rays_->scene(), point, -walk.ray.direction);
  const float own = walk.density > 0 ? walk.density : walk.density_before;
  if (!positive(luminance) || !(own > 0)) return luminance;
  const std::int32_t light = luminaires_->light_of(point.triangle);
  if (light < 0) return luminance;
  const auto i = static_cast<std::size_t>(light);
  const float cos_light = std::fabs(glm::dot(walk.ray.direction, point.geometric_normal));
  const float chosen = walk.every_light ? 1 : share_[i];
  Vec3 from = walk.from;
  if (!(walk.density > 0)) {
    const std::int32_t chain = image_chain(walk);
    if (chain == MirrorPlanes::kNone) return luminance;  // no image counts this light
    from = luminaires_->mirrors().image(chain, walk.from);
  }
  const float density =
      chosen * luminaires_->density(i, from, point.triangle, walk.travelled_m + point.distance_m, cos_light);
  return luminance * power_weight(own, density);
}

/// The same of the environment, for a walk whose ray left the scene.
Rgb EyePathTracer::emission_beyond(const Walk& walk) const {
  const Scene& scene = rays_->scene();
  const Rgb luminance = background_luminance(scene, walk.ray.direction);
  if (!positive(luminance) || luminaires_->environment() < 0) return luminance;
  const float chosen = walk.every_light ? 1 : share_[static_cast<std::size_t>(luminaires_->environment())];
  if (walk.density > 0)
    return luminance *
           power_weight(walk.density, chosen * luminaires_->density_beyond(walk.from, walk.ray.direction));
  // The sun's image in flat mirrors is sampled from where the mirrors were looked into.
  const Rgb sun = walk.density_before > 0 ? sun_luminance(scene, walk.ray.direction) : Rgb(0);
  if (!positive(sun) || image_chain(walk) == MirrorPlanes::kNone) return luminance;
  const auto density = static_cast<float>(static_cast<double>(chosen) / scene.environment->sun_sr());
  return luminance - sun + sun * power_weight(walk.density_before, density);
}

/// The chain of flat mirrors since the last other event, as the lamp sees it; kNone: it is not taken.
std::int32_t EyePathTracer::image_chain(const Walk& walk) const {
  std::int32_t chain = MirrorPlanes::kNone;
  for (auto m = walk.mirrors.rbegin(); m != walk.mirrors.rend(); ++m) {
    chain = luminaires_->mirrors().follow(chain, m->triangle, m->front);
    if (chain == MirrorPlanes::kNone) break;
  }
  return chain;
}

void EyePathTracer::add_emission(const Rgb& luminance, const Walk& walk, PathSample& sum) {
  const Rgb light = walk.throughput * luminance;
  if (!walk.mirrored && walk.scatterings > 1) return add_indirect(light, walk, sum);
  (walk.mirrored ? sum.specular : walk.scatterings == 0 ? sum.emission : sum.direct) += light;
}

void EyePathTracer::add_indirect(const Rgb& light, const Walk& walk, PathSample& sum) {
  sum.glossy += walk.glossy * light;
  sum.indirect += (Rgb(1) - walk.glossy) * light;
}

/// Keeps where densities count from: the last event that was no flat mirror.
void EyePathTracer::note_mirror(const SurfacePoint& point, const BsdfSample& next, Walk& walk) const {
  if (!next.specular) {
    walk.from = point.position, walk.travelled_m = 0;
    walk.mirrors.clear(), walk.density_before = 0;
    return;
  }
  if (walk.density > 0) walk.density_before = walk.density;
  walk.travelled_m += point.distance_m;
  if (next.transmitted || luminaires_->mirrors().empty()) walk.density_before = 0;
  if (walk.density_before > 0) walk.mirrors.push_back({point.triangle, point.front});
}

/// Adds the light scattered at `point` once, and turns the walk into its next ray, or lets it pass straight.
/// `lit`: lamps count.
EyePathTracer::Next EyePathTracer::scatter(const SurfacePoint& point, const Bsdf& bsdf, bool lit, Walk& walk,
                                           PathSample& sum, RandomStream& random) const {
  const Vec3 wo = -walk.ray.direction;
  random.start_bounce(static_cast<std::uint32_t>(walk.events));
  const bool every_light = sample_every_light(walk.scatterings);
  if (lit && bsdf.scatters()) {
    const auto scatter = [&](const Vec3& wi, float& density) {
      const Rgb f = bsdf.evaluate(wo, wi);
      if (positive(f)) density = bsdf.density(wo, wi);
      return f * std::fabs(glm::dot(point.normal, wi));
    };
    const Rgb light = walk.throughput * light_at(point, every_light, scatter, random);
    if (!walk.mirrored && walk.scatterings > 0)
      add_indirect(light, walk, sum);
    else
      (walk.mirrored ? sum.specular : sum.direct) += light;
  }
  BsdfSample next;
  const float u_lobe = random.uniform();
  if (!bsdf.sample(wo, u_lobe, random.uniform2(), next)) return Next::none;
  ++walk.events;
  if (next.straight) {
    // No event of the path: densities and distances count from where the ray began.
    walk.throughput *= next.weight;
    if (walk.scatterings == 0) walk.mirrored = true;  // the eye sees it through glass
    return positive(walk.throughput) && walk.events < kMostEvents.most ? Next::straight : Next::none;
  }
  if (!next.specular) walk.every_light = every_light;
  if (walk.scatterings == 0) {
    walk.mirrored = walk.mirrored || next.specular;
    if (!walk.mirrored && bsdf.has_gloss()) {
      const Rgb all = bsdf.evaluate(wo, next.direction), gloss = bsdf.evaluate_gloss(wo, next.direction);
      for (int c = 0; c < 3; ++c) walk.glossy[c] = all[c] > 0 ? gloss[c] / all[c] : 0;
    }
  }
  walk.throughput *= next.weight;
  note_mirror(point, next, walk);
  walk.density = next.specular ? 0 : next.density;
  walk.ray = {point.leave(next.direction), next.direction, 0, kInfinity};
  ++walk.scatterings;
  const float in_glass = walk.total_reflections.survival(bsdf.total_reflection(wo));
  if (!survives(walk.scatterings, std::min(max_component(walk.throughput), in_glass), random,
                walk.throughput))
    return Next::none;
  return positive(walk.throughput) && walk.events < kMostEvents.most ? Next::ray : Next::none;
}

void EyePathTracer::follow(Walk walk, PathSample& sum, RandomStream& random) const {
  for (Next next = Next::ray; next == Next::ray;) {
    Way way(*rays_, walk.ray);
    SurfacePoint point;
    do {
      if (!way.next(point)) return add_emission(emission_beyond(walk), walk, sum);
      add_emission(emission_at(point, walk), walk, sum);
      const Bsdf bsdf = way.bsdf(point);
      const bool ends = options_.bounces >= 0 && walk.scatterings >= options_.bounces;
      const bool black = options_.black_emitters && rays_->scene().material[point.material].emits();
      if (black || (ends && !bsdf.passes_straight())) return;
      next = scatter(point, bsdf, !ends, walk, sum, random);
      if (ends && next != Next::straight) return;
    } while (next == Next::straight);
  }
}

PathSample EyePathTracer::luminance(const Ray& ray, RandomStream& random) const {
  PathSample sum;
  Walk walk;
  walk.ray = ray;
  follow(walk, sum, random);
  return sum;
}

Rgb EyePathTracer::irradiance(const SurfacePoint& sensor, RandomStream& random) const {
  if (options_.bounces == 0) return Rgb(0);
  random.start_bounce(0);
  Walk walk;
  walk.every_light = sample_every_light(0);
  const auto cosine = [&](const Vec3& wi, float& density) {
    const float cos_theta = std::fmax(0.f, glm::dot(sensor.geometric_normal, wi));
    density = cos_theta / kPi;
    return Rgb(cos_theta);
  };
  Rgb lux = light_at(sensor, walk.every_light, cosine, random);
  const Vec3 local = sample_cosine_hemisphere(random.uniform2());
  if (local.z <= 0) return lux;
  const Vec3 direction = make_frame(sensor.geometric_normal).to_world(local);
  walk.ray = {sensor.leave(direction), direction, 0, kInfinity};
  walk.from = sensor.position;
  walk.density = local.z / kPi;
  walk.scatterings = walk.events = 1;
  PathSample sum;
  follow(walk, sum, random);
  return lux + kPi * sum.total();  // cos / density = pi
}

Rgb EyePathTracer::direct(const SurfacePoint& point, const std::function<Rgb(const Vec3&)>& f_cos,
                          RandomStream& random) const {
  // No path of its own samples the direction: shadow rays weigh whole.
  const auto scatter = [&](const Vec3& wi, float& /*density*/) { return f_cos(wi); };
  return light_at(point, sample_every_light(0), scatter, random);
}

}  // namespace phos::inline reference
