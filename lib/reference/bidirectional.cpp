#include "reference/bidirectional.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/sampling.h"
#include "reference/limits.h"
#include "reference/roulette.h"
#include "scene/material/passage.h"
#include "scene/material/sharp_materials.h"
#include "scene/material/total_reflections.h"

namespace phos::inline reference {
namespace {

// At the first scattering up to so many lamps are sampled one by one.
constexpr std::size_t kEveryLampUpTo = 8;
// Paths merge where their surfaces' normals are within 60 degrees.
constexpr float kSameSurface = 0.5f;

bool positive(const Rgb& c) { return max_component(c) > 0; }

/// Does nothing stand between two places of one surface? Both are lifted over the height that a curved
/// surface rises between them.
bool nothing_between(const RayScene& rays, const SurfacePoint& a, const SurfacePoint& b) {
  const Vec3 way = b.position - a.position;
  const float rise_m =
      std::max(std::fabs(glm::dot(way, a.geometric_normal)), std::fabs(glm::dot(way, b.geometric_normal)));
  const auto lifted = [rise_m](SurfacePoint p) {
    p.position += rise_m * p.geometric_normal;
    return p;
  };
  return rays.visible(lifted(a), lifted(b));
}
double to_double(float x) { return static_cast<double>(x); }

void add_indirect(const Rgb& light, const Rgb& glossy, PathSample& sum) {
  sum.glossy += glossy * light;
  sum.indirect += (Rgb(1) - glossy) * light;
}

/// Share of the light reflected from wi to wo that is gloss.
Rgb glossy_share(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) {
  Rgb share(0);
  if (!bsdf.has_gloss()) return share;
  const Rgb all = bsdf.evaluate(wo, wi), gloss = bsdf.evaluate_gloss(wo, wi);
  for (int c = 0; c < 3; ++c) share[c] = all[c] > 0 ? gloss[c] / all[c] : 0;
  return share;
}

}  // namespace

/// An eye path on its way: the edge that it goes along, and the vertex that it began at.
struct BidirectionalTracer::Walk {
  Ray ray;
  Vec3 from{0};  // where the ray was chosen, before it was lifted off the surface
  Rgb throughput{1};
  float start = 1;          // throughput that it began with
  double density = 0;       // of the direction, per sr; 1 of a mirror's
  double cos_leaving = 1;   // there
  double behind = 0;        // kappa / f + rho V there
  double merge_behind = 0;  // eta of merging there
  bool parallel = false;    // `density` is per m2 across the ray
  bool mirror = false;      // how it was scattered there
  bool every_lamp = false;  // how next-event estimation chose there
  bool camera = false;      // the ray is a camera's
  double light_paths = 1;   // connected to the vertex there for each path
  bool mirrored = false;    // the visible surface is a mirror or glass
  Rgb glossy{0};            // share of the path's light that the visible surface's gloss reflects
  std::int64_t scatterings = 0;
  std::int32_t events = 0;  // scatterings and panes passed: numbers the random draws
  TotalReflections total_reflections;
};

/// Where it has come to: a surface, or the sensor.
struct BidirectionalTracer::Vertex {
  const SurfacePoint* point = nullptr;
  const Bsdf* bsdf = nullptr;  // null: a sensor
  Vec3 wo{0};
  double connect = 0;       // kappa / f
  double before = 0;        // V, but for merging at the vertex before,
  double merge_before = 0;  // which comes to it where the path is scattered sharply here
  double merge = 0;         // eta of merging here
  bool sharp = false;       // the material reflects sharply
  bool visible = false;     // seen by a camera straight away
  bool in_grid = false;     // merged with the vertices about it

  /// U + rho V over merging here, at a scattering that is not a mirror's.
  SubPathEnd end() const { return {connect, 0, before + (sharp ? merge_before : 0)}; }
};

struct BidirectionalTracer::Scattered {
  Rgb f_cos{0};
  double onward = 0, back = 0;  // density of that direction, and of the way back from it, per sr
};

BidirectionalTracer::BidirectionalTracer(const RayScene& rays, const Luminaires& luminaires,
                                         const LightStarts& lamps, const PathOptions& options)
    : rays_(&rays), luminaires_(&luminaires), lamps_(&lamps), options_(options) {}

bool BidirectionalTracer::samples_every_lamp(std::int64_t scatterings) const {
  return luminaires_->size() == 1 || (scatterings == 0 && luminaires_->size() <= kEveryLampUpTo);
}

BidirectionalTracer::Scattered BidirectionalTracer::scattered(const Vertex& at, const Vec3& wi) const {
  Scattered s;
  if (!at.bsdf) {
    const float cosine = std::fmax(0.f, glm::dot(at.point->geometric_normal, wi));
    s.f_cos = Rgb(cosine);
    s.onward = to_double(cosine) / std::numbers::pi;
    return s;
  }
  s.f_cos = at.bsdf->evaluate(at.wo, wi) * std::fabs(glm::dot(at.point->normal, wi));
  if (!positive(s.f_cos)) return s;
  s.onward = to_double(at.bsdf->density(at.wo, wi));
  s.back = to_double(at.bsdf->density(wi, at.wo));
  return s;
}

/// Light that was scattered at `at` from wi, `scatterings` in all on its way.
void BidirectionalTracer::add(const Rgb& light, std::int64_t scatterings, const Vertex& at, const Vec3& wi,
                              const Walk& walk, PathSample& sum) const {
  if (walk.mirrored)
    sum.specular += light;
  else if (scatterings == 1 || !at.bsdf)
    sum.direct += light;
  else
    add_indirect(light, at.visible ? glossy_share(*at.bsdf, at.wo, wi) : walk.glossy, sum);
}

/// A lamp that the walk came to: `shadow_rays`, `light_path`: densities of the other ways to make it (of
/// shadow rays, and of light paths) over this one.
void BidirectionalTracer::add_hit(const Rgb& luminance, double shadow_rays, double light_path,
                                  const Walk& walk, PathSample& sum) const {
  // What a camera sees straight away nothing else makes.
  const double weight = walk.camera ? 1 : balance(shadow_rays, light_path);
  const Rgb light = walk.throughput * luminance * static_cast<float>(weight);
  if (!walk.mirrored && walk.scatterings > 1) return add_indirect(light, walk.glossy, sum);
  (walk.mirrored ? sum.specular : walk.scatterings == 0 ? sum.emission : sum.direct) += light;
}

void BidirectionalTracer::add_hit_at(const SurfacePoint& point, const Walk& walk, PathSample& sum) const {
  const Rgb luminance = emitted_luminance(rays_->scene(), point, -walk.ray.direction);
  if (!positive(luminance)) return;
  const std::int32_t light = luminaires_->light_of(point.triangle);
  if (light < 0 || walk.camera) return add_hit(luminance, 0, 0, walk, sum);
  const auto i = static_cast<std::size_t>(light);
  const float cos_lamp = std::fabs(glm::dot(walk.ray.direction, point.geometric_normal));
  if (!(cos_lamp > 0)) return;
  double shadow_rays = 0;
  if (!walk.mirror)
    shadow_rays = (walk.every_lamp ? 1 : lamps_->share(i)) *
                  to_double(luminaires_->density(i, walk.from, point.triangle, point.distance_m, cos_lamp)) /
                  walk.density;
  const double start =
      lamps_->density(i, point.position, point.triangle, point.geometric_normal, -walk.ray.direction);
  const double light_path = start * walk.cos_leaving / (walk.density * to_double(cos_lamp)) * walk.behind;
  add_hit(luminance, shadow_rays, light_path, walk, sum);
}

void BidirectionalTracer::add_hit_beyond(const Walk& walk, PathSample& sum) const {
  const Rgb luminance = background_luminance(rays_->scene(), walk.ray.direction);
  if (!positive(luminance)) return;
  if (luminaires_->environment() < 0 || walk.camera) return add_hit(luminance, 0, 0, walk, sum);
  const auto i = static_cast<std::size_t>(luminaires_->environment());
  double shadow_rays = 0;
  if (!walk.mirror)
    shadow_rays = (walk.every_lamp ? 1 : lamps_->share(i)) *
                  to_double(luminaires_->density_beyond(walk.from, walk.ray.direction)) / walk.density;
  const Vec3 towards = -walk.ray.direction;
  const double light_path =
      lamps_->density(i, walk.from, 0, towards, towards) * walk.cos_leaving / walk.density * walk.behind;
  add_hit(luminance, shadow_rays, light_path, walk, sum);
}

/// One shadow ray, to lamp i, which was chosen with that probability.
void BidirectionalTracer::add_lamp(std::size_t i, double choice, const Vertex& at, const Walk& walk,
                                   RandomStream& random, PathSample& sum) const {
  Illumination light;
  const float u_part = random.uniform();
  if (!luminaires_->illuminate(i, at.point->position, u_part, random.uniform2(), light)) return;
  const Scattered s = scattered(at, light.direction);
  if (!positive(s.f_cos)) return;
  const Rgb share = arriving_share(*rays_, *at.point, light);
  if (!positive(share)) return;
  const bool infinite = !std::isfinite(light.distance_m), extended = light.density > 0;
  const double cos_at = std::fabs(to_double(glm::dot(light.direction, at.point->geometric_normal)));
  const double distance2 = infinite ? 1 : to_double(light.distance_m) * to_double(light.distance_m);
  // Of shadow rays: per sr of an extended lamp, else of the choice alone.
  const double own = choice * (extended ? to_double(light.density) : 1);
  const bool area = extended && !infinite;
  const double cos_lamp = area ? std::fabs(to_double(glm::dot(light.direction, light.normal))) : 1;
  const double start = lamps_->density(i, infinite ? at.point->position : light.position, light.triangle,
                                       light.normal, -light.direction);
  const double start_here = start * cos_at / (own * (area ? cos_lamp : distance2));
  const double hit = extended ? s.onward / own : 0;
  const double weight = balance(hit, at.end().left_to_the_other(start_here, s.back));
  const Rgb value = walk.throughput * share * s.f_cos * light.value * static_cast<float>(weight / own);
  add(value, walk.scatterings + 1, at, light.direction, walk, sum);
}

void BidirectionalTracer::add_lamps(const Vertex& at, const Walk& walk, RandomStream& random,
                                    PathSample& sum) const {
  if (lamps_->none()) return;
  if (samples_every_lamp(walk.scatterings)) {
    for (std::size_t i = 0; i < luminaires_->size(); ++i) add_lamp(i, 1, at, walk, random, sum);
  } else {
    const std::size_t i = lamps_->choose_light(random.uniform_double());
    if (lamps_->share(i) > 0) add_lamp(i, lamps_->share(i), at, walk, random, sum);
  }
}

namespace {

/// What a light path's vertex sends in unit direction `towards`, and the density with which it would be
/// entered from there and go back to the lamp, or go on there, per sr.
struct Sent {
  Rgb light{0};
  double onward = 0, back = 0;
};

Sent sent(const LightVertex& y, const Vec3& towards) {
  Sent s;
  const Rgb f = y.bsdf.evaluate(y.towards_lamp, towards);
  if (!positive(f)) return s;
  const Vec3 &normal = y.point.normal, &geometric = y.point.geometric_normal;
  // Flux crosses the surface by the geometric normal, and is scattered by the shading one (Veach 1997, 5.3).
  const float landed = std::fabs(glm::dot(y.towards_lamp, geometric));
  if (!(landed > 0)) return s;
  s.light = y.flux_lm * f * (std::fabs(glm::dot(y.towards_lamp, normal)) / landed);
  s.onward = to_double(y.bsdf.density(y.towards_lamp, towards));
  s.back = to_double(y.bsdf.density(towards, y.towards_lamp));
  return s;
}

}  // namespace

void BidirectionalTracer::connect(const Vertex& at, const LightVertex& y, const Walk& walk,
                                  PathSample& sum) const {
  const std::int64_t scatterings = walk.scatterings + 1 + y.scatterings + 1;
  if (options_.bounces >= 0 && scatterings > options_.bounces) return;
  const Vec3 way = y.point.position - at.point->position, wi = normalized_or_zero(way);
  const double distance = to_double(glm::dot(way, wi)), distance2 = distance * distance;
  if (!(distance2 > 0)) return;
  const Scattered z = scattered(at, wi);
  if (!positive(z.f_cos)) return;
  const Sent s = sent(y, -wi);
  if (!positive(s.light)) return;
  const double cos_y = std::fabs(to_double(glm::dot(wi, y.point.geometric_normal)));
  const double cos_z = std::fabs(to_double(glm::dot(wi, at.point->geometric_normal)));
  // The eye path's end could be merged where the light path's scatters sharply.
  SubPathEnd end = at.end();
  if (y.sharp) end.merge = at.merge;
  const double weight = balance(y.end.left_to_the_other(z.onward * cos_y / distance2, s.back),
                                end.left_to_the_other(s.onward * cos_z / distance2, z.back));
  const Rgb light = walk.throughput * z.f_cos * s.light * static_cast<float>(weight * cos_y / distance2);
  if (!positive(light)) return;
  const Rgb share = arriving_share(*rays_, ray_between(*at.point, y.point.position, y.point.error_m));
  if (positive(share)) add(share * light, scatterings, at, wi, walk, sum);
}

void BidirectionalTracer::merge(const Vertex& at, const LightPass& pass, const Walk& walk,
                                BidirectionalSample& sample) const {
  const double eta = pass.merge_eta;
  const float inner2 = 0.5f * pass.grid.radius_m() * pass.grid.radius_m();
  pass.grid.about(at.point->position, [&](const LightVertex& v, float distance2) {
    const std::int64_t scatterings = walk.scatterings + 1 + v.scatterings;
    if (options_.bounces >= 0 && scatterings > options_.bounces) return;
    const Vec3 &n = at.point->geometric_normal, &wi = v.towards_lamp;
    // What landed on the other side of a sheet comes through it.
    const float facing = glm::dot(n, v.point.geometric_normal);
    if ((at.bsdf && at.bsdf->transmits_diffusely() ? std::fabs(facing) : facing) < kSameSurface) return;
    const float landed = std::fabs(glm::dot(wi, n));
    const Scattered s = scattered(at, wi);
    if (!positive(s.f_cos) || !(landed > 0)) return;
    const double weight =
        balance(v.end.instead_of_merging(eta, s.onward), at.end().instead_of_merging(eta, s.back));
    const Rgb light =
        walk.throughput * v.flux_lm * s.f_cos * static_cast<float>(weight / (to_double(landed) * eta));
    if (!positive(light) || (facing > 0 && !nothing_between(*rays_, *at.point, v.point))) return;
    const bool inner = distance2 <= inner2;
    if (inner) add(light, scatterings, at, wi, walk, sample.sum);
    sample.bias += (inner ? -0.5f : 0.5f) * light;
  });
}

/// All light that is scattered once at a vertex on its way from lamps and light paths.
void BidirectionalTracer::gather(const Vertex& at, const LightPass& pass, std::size_t path, const Walk& walk,
                                 RandomStream& random, BidirectionalSample& sample) const {
  add_lamps(at, walk, random, sample.sum);
  for (std::uint32_t i = pass.paths.first[path]; i < pass.paths.first[path + 1]; ++i)
    connect(at, pass.paths.vertex[i], walk, sample.sum);
  if (at.in_grid) merge(at, pass, walk, sample);
}

BidirectionalTracer::Vertex BidirectionalTracer::vertex_at(const SurfacePoint& point, const Bsdf& bsdf,
                                                           const Walk& walk) const {
  Vertex at;
  at.point = &point, at.bsdf = &bsdf, at.wo = -walk.ray.direction;
  at.visible = walk.camera;
  at.sharp = reflects_sharply(rays_->scene().material[point.material]);
  const double cosine = std::fabs(to_double(glm::dot(at.wo, point.geometric_normal)));
  const double distance = to_double(point.distance_m);
  const double across = walk.density * cosine;  // f d^2, or f
  if (!walk.mirror) at.connect = walk.light_paths * (walk.parallel ? 1 : distance * distance) / across;
  at.before = walk.cos_leaving / across * walk.behind;
  at.merge_before = walk.cos_leaving / across * walk.merge_behind;
  for (double* x : {&at.connect, &at.before, &at.merge_before})
    if (!std::isfinite(*x)) *x = 0;
  return at;
}

/// Turns the walk into its next ray, or lets it pass straight.
BidirectionalTracer::Next BidirectionalTracer::scatter(const Vertex& at, Walk& walk,
                                                       RandomStream& random) const {
  BsdfSample next;
  const float u_lobe = random.uniform();
  if (!at.bsdf->sample(at.wo, u_lobe, random.uniform2(), next)) return Next::none;
  ++walk.events;
  walk.throughput *= next.weight;
  if (!positive(walk.throughput) || walk.events >= kMostEvents.most) return Next::none;
  if (next.straight) return Next::straight;
  walk.every_lamp = samples_every_lamp(walk.scatterings);
  if (at.visible) {
    walk.mirrored = next.specular;
    if (!next.specular) walk.glossy = glossy_share(*at.bsdf, at.wo, next.direction);
  }
  const double back = next.specular ? 1 : to_double(at.bsdf->density(next.direction, at.wo));
  const bool sharp = next.specular || at.sharp;
  walk.behind = (next.specular ? 0 : at.connect) + back * (at.before + (sharp ? at.merge_before : 0));
  walk.merge_behind = next.specular ? 0 : at.merge;
  walk.density = next.specular ? 1 : to_double(next.density);
  walk.cos_leaving = std::fabs(to_double(glm::dot(next.direction, at.point->geometric_normal)));
  walk.mirror = next.specular;
  walk.camera = walk.parallel = false;
  walk.light_paths = 1;
  walk.ray = {at.point->leave(next.direction), next.direction, 0, kInfinity};
  walk.from = at.point->position;
  ++walk.scatterings;
  const float in_glass = walk.total_reflections.survival(at.bsdf->total_reflection(at.wo));
  const float share = std::min(max_component(walk.throughput) / walk.start, in_glass);
  return survives(walk.scatterings, share, random, walk.throughput) ? Next::ray : Next::none;
}

void BidirectionalTracer::follow(Walk& walk, const LightPass& pass, std::size_t path, RandomStream& random,
                                 BidirectionalSample& sample) const {
  for (Next next = Next::ray; next == Next::ray;) {
    Way way(*rays_, walk.ray);
    SurfacePoint point;
    do {
      if (!way.next(point)) return add_hit_beyond(walk, sample.sum);
      add_hit_at(point, walk, sample.sum);
      const Bsdf bsdf = way.bsdf(point);
      const bool ends = options_.bounces >= 0 && walk.scatterings >= options_.bounces;
      const bool black = options_.black_emitters && rays_->scene().material[point.material].emits();
      if (black || (ends && !bsdf.passes_straight())) return;
      random.start_bounce(static_cast<std::uint32_t>(walk.events));
      Vertex at = vertex_at(point, bsdf, walk);
      if (!ends && bsdf.scatters()) {
        const bool broad = bsdf.has_diffuse() || bsdf.transmits_diffusely() || !at.sharp;
        // What a camera sees straight away light paths bring it themselves.
        at.in_grid = !walk.camera && !pass.grid.empty() && broad;
        if (!walk.camera && broad) at.merge = pass.merge_eta;
        gather(at, pass, path, walk, random, sample);
      }
      next = scatter(at, walk, random);
      if (ends && next != Next::straight) return;
    } while (next == Next::straight);
  }
}

BidirectionalSample BidirectionalTracer::luminance(const Ray& ray, const EyeStart& start,
                                                   const LightPass& pass, std::size_t path,
                                                   RandomStream& random) const {
  BidirectionalSample sample;
  Walk walk;
  walk.ray = ray;
  walk.from = ray.origin;
  walk.density = start.density, walk.parallel = start.parallel, walk.light_paths = start.light_paths;
  walk.camera = true;
  follow(walk, pass, path, random, sample);
  return sample;
}

BidirectionalSample BidirectionalTracer::irradiance(const SurfacePoint& sensor, double disc_eta,
                                                    const LightPass& pass, std::size_t path,
                                                    RandomStream& random) const {
  Vertex at;
  at.point = &sensor;
  at.merge = disc_eta;
  return irradiance(at, pass, path, random);
}

BidirectionalSample BidirectionalTracer::surface_irradiance(const SurfacePoint& point, const LightPass& pass,
                                                            std::size_t path, RandomStream& random) const {
  Vertex at;
  at.point = &point;
  at.merge = pass.merge_eta;
  at.in_grid = !pass.grid.empty();
  return irradiance(at, pass, path, random);
}

BidirectionalSample BidirectionalTracer::irradiance(const Vertex& sensor, const LightPass& pass,
                                                    std::size_t path, RandomStream& random) const {
  BidirectionalSample sample;
  if (options_.bounces == 0) return sample;
  random.start_bounce(0);
  Walk walk;
  gather(sensor, pass, path, walk, random, sample);
  const Vec3& normal = sensor.point->geometric_normal;
  const Vec3 local = sample_cosine_hemisphere(random.uniform2());
  if (local.z <= 0) return sample;
  const Vec3 direction = make_frame(normal).to_world(local);
  walk.ray = {sensor.point->leave(direction), direction, 0, kInfinity};
  walk.from = sensor.point->position;
  walk.every_lamp = samples_every_lamp(0);
  walk.density = to_double(local.z) / std::numbers::pi;
  walk.cos_leaving = to_double(local.z);
  walk.merge_behind = sensor.merge;
  walk.throughput = Rgb(kPi), walk.start = kPi;  // cos / density
  walk.scatterings = walk.events = 1;
  follow(walk, pass, path, random, sample);
  return sample;
}

PathSample BidirectionalTracer::splat(const LightVertex& vertex, const Vec3& towards, float distance_m,
                                      const EyeStart& start) const {
  PathSample sum;
  const std::int64_t scatterings = vertex.scatterings + 1;
  if (options_.bounces >= 0 && scatterings > options_.bounces) return sum;
  const Sent s = sent(vertex, towards);
  if (!positive(s.light)) return sum;
  const double cosine = std::fabs(to_double(glm::dot(towards, vertex.point.geometric_normal)));
  const double density =
      start.density * cosine / (start.parallel ? 1 : to_double(distance_m) * to_double(distance_m));
  // Its paths are not merged there, and shadow rays go to every lamp.
  SubPathEnd end = vertex.end;
  end.merge = 0;
  if (vertex.scatterings == 0 && samples_every_lamp(0)) end.connect *= vertex.every_light;
  const double weight = balance(end.left_to_the_other(density, s.back) / start.light_paths, 0);
  const Rgb light = s.light * static_cast<float>(density * weight);
  if (!positive(light)) return sum;
  const Rgb share = arriving_share(*rays_, Ray{vertex.point.leave(towards), towards, 0, distance_m});
  if (!positive(share)) return sum;
  if (scatterings == 1)
    sum.direct = share * light;
  else
    add_indirect(share * light, glossy_share(vertex.bsdf, towards, vertex.towards_lamp), sum);
  return sum;
}

}  // namespace phos::inline reference
