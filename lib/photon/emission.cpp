#include "photon/emission.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/sampling.h"
#include "scene/load.h"
#include "scene/sky/environment.h"

namespace phos::inline photon {
namespace {

constexpr std::uint64_t kLastTick = std::numeric_limits<std::uint64_t>::max();
constexpr int kFluxBits = 46;
/// Share of the environment's paths that are not aimed at portals.
constexpr float kStray = 0.1f;

std::uint64_t reversed_bits(std::uint64_t v) {
  v = (v & 0x5555555555555555u) << 1 | (v >> 1 & 0x5555555555555555u);
  v = (v & 0x3333333333333333u) << 2 | (v >> 2 & 0x3333333333333333u);
  v = (v & 0x0f0f0f0f0f0f0f0fu) << 4 | (v >> 4 & 0x0f0f0f0f0f0f0f0fu);
  return __builtin_bswap64(v);
}

// The intensity is 1 in the cap and rises to it through the ring.
struct Cone {
  double cap, ring, outer, rise;
};

Cone cone(double cos_inner, double cos_outer) {
  const double outer = cos_outer, inner = std::max(outer, cos_inner);
  return {1 - inner, (inner - outer) / 3, outer, inner - outer};
}

}  // namespace

double spot_solid_angle_sr(double cos_inner, double cos_outer) {
  const Cone c = cone(cos_inner, cos_outer);
  return 2 * std::numbers::pi * (c.cap + c.ring);
}

double sample_spot_cosine(double cos_inner, double cos_outer, float u) {
  const Cone c = cone(cos_inner, cos_outer);
  const double x = static_cast<double>(u) * (c.cap + c.ring);
  const bool in_cap = x < c.cap || c.ring == 0;
  const double cosine = in_cap ? 1 - x : c.outer + c.rise * std::cbrt((x - c.cap) / c.ring);
  return std::clamp(cosine, -1.0, 1.0);
}

Emitter::Emitter(const Scene& scene, double minimum_share, std::uint64_t paths, std::uint64_t seed)
    : scene_(&scene), luminaires_(scene), bounding_radius_m_(bounding_radius_m(scene)) {
  if (scene.environment && !scene.portal.empty()) portals_.emplace(scene.portal, *scene.environment);
  if (luminaires_.size() == 0 && scene.bands.number > 0)
    throw Error(ExitCode::bad_input, scene.path,
                text("no light: no lamp shines in triplet ", scene.bands.triplet, " of ", scene.bands.number,
                     " bands; leave it out, and tell phos-bands: --dark ", scene.bands.triplet));
  if (luminaires_.size() == 0)
    throw Error(ExitCode::bad_input, scene.path,
                text("no light: the scene has no lamp and no emissive material; ", how_to_add_to(scene),
                     "; phos-scene lists the lights of a scene"));
  share_ = luminaires_.power_shares(minimum_share, portals_ ? portals_->flux_lm() : -1);
  Rgb total(0);
  double shares = 0;
  for (std::size_t i = 0; i < share_.size(); ++i) {
    const Rgb flux = luminaires_[i].flux_lm;
    if (!(max_component(flux) > 0)) share_[i] = 0;
    total += flux;
    shares += share_[i];
  }
  if (!(shares > 0) || !is_finite(total))
    throw Error(ExitCode::bad_input, scene.path,
                text("no light: the ", share_.size(), " lights of the scene emit ", max_component(total),
                     " lm; give them a finite power above 0"));
  double sum = 0;
  for (double& share : share_) {
    share /= shares;
    scale_.push_back(share > 0 ? static_cast<float>(1 / (share * static_cast<double>(paths))) : 0);
    sum += share;
    last_.push_back(sum >= 1 ? kLastTick : static_cast<std::uint64_t>(std::ldexp(sum, 64)));
  }
  // Rounding must not leave the last ticks to nobody, nor give them to a dark light.
  std::size_t last = share_.size() - 1;
  while (share_[last] == 0) --last;
  std::fill(last_.begin() + static_cast<std::ptrdiff_t>(last), last_.end(), kLastTick);
  flux_exponent_ = std::ilogb(max_component(total)) + 1 - kFluxBits;
  RandomStream random(seed, Stage::emission, 0);
  random.start_bounce(0);
  rotation_ = static_cast<std::uint64_t>(random.bits()) << 32;
  rotation_ |= random.bits();
}

double Emitter::aimed_lm() const {
  const std::int32_t sky = luminaires_.environment();
  if (!portals_ || sky < 0) return 0;
  return portals_->flux_lm() / (1 - static_cast<double>(kStray)) *
         static_cast<double>(scale_[static_cast<std::size_t>(sky)]);
}

std::size_t Emitter::light_of(std::uint64_t path) const {
  const std::uint64_t tick = reversed_bits(path) + rotation_;
  return static_cast<std::size_t>(std::lower_bound(last_.begin(), last_.end(), tick) - last_.begin());
}

EmittedPhoton Emitter::emit(std::uint64_t path, RandomStream& random) const {
  const std::size_t i = light_of(path);
  EmittedPhoton photon = start(i, random);
  photon.flux_lm *= scale_[i];
  return photon;
}

EmittedPhoton Emitter::start(std::size_t i, RandomStream& random) const {
  const Light& light = luminaires_[i];
  switch (light.kind) {
    case Light::Kind::area:
      return light.fitting < 0 ? from_area(i, random) : from_opening(i, random);
    case Light::Kind::measured:
      return from_measured(light, random);
    case Light::Kind::point:
      return from_point(light, random);
    case Light::Kind::spot:
      return from_spot(light, random);
    case Light::Kind::directional:
      return from_infinity(light.direction, light.intensity, random);
    case Light::Kind::environment:
      return from_environment(random);
  }
  return {};
}

EmittedPhoton Emitter::from_area(std::size_t i, RandomStream& random) const {
  const float u_triangle = random.uniform();
  const Vec2 u = random.uniform2();
  const Vec2 u_direction = random.uniform2();
  const EmissionPoint point = luminaires_.sample_point(i, u_triangle, u);
  EmittedPhoton photon;
  if (!(point.density > 0)) return photon;
  const bool both_sides = scene_->material_of(point.triangle).double_sided;
  const bool back = both_sides && random.uniform() < 0.5f;
  photon.source_normal = back ? -point.normal : point.normal;
  photon.ray.direction = make_frame(photon.source_normal).to_world(sample_cosine_hemisphere(u_direction));
  photon.ray.origin = point.position + point.error_m * photon.source_normal;
  // Exitance of one side is pi L; the cosine and 1/pi of the direction cancel.
  photon.flux_lm = (both_sides ? 2 * kPi : kPi) / point.density * point.luminance;
  return photon;
}

/// First the direction, by the intensities; then a place on the part of the opening that is seen from there.
/// All photons of a luminaire have the same flux.
EmittedPhoton Emitter::from_opening(std::size_t i, RandomStream& random) const {
  const Fitting& fitting = scene_->fitting[static_cast<std::size_t>(luminaires_[i].fitting)];
  const Vec3 direction = fitting.sample_direction(random.uniform2());
  const float u_triangle = random.uniform();
  const EmissionPoint point = luminaires_.sample_seen_from(i, direction, u_triangle, random.uniform2());
  EmittedPhoton photon;
  if (!(point.density > 0)) return photon;
  photon.source_normal = point.normal;
  photon.ray.direction = direction;
  photon.ray.origin = point.position + point.error_m * point.normal;
  photon.flux_lm = fitting.flux_lm();
  return photon;
}

EmittedPhoton Emitter::from_measured(const Light& light, RandomStream& random) const {
  const Fitting& fitting = scene_->fitting[static_cast<std::size_t>(light.fitting)];
  EmittedPhoton photon;
  photon.ray.origin = light.position;
  photon.ray.direction = fitting.sample_direction(random.uniform2());
  photon.source_normal = photon.ray.direction;
  photon.flux_lm = light.flux_lm;
  return photon;
}

EmittedPhoton Emitter::from_point(const Light& light, RandomStream& random) const {
  EmittedPhoton photon;
  photon.ray.origin = light.position;
  photon.ray.direction = sample_uniform_sphere(random.uniform2());
  photon.source_normal = photon.ray.direction;
  photon.flux_lm = 4 * kPi * light.intensity;
  return photon;
}

EmittedPhoton Emitter::from_spot(const Light& light, RandomStream& random) const {
  const Vec2 u = random.uniform2();
  const double cosine = sample_spot_cosine(light.cos_inner, light.cos_outer, u.x);
  const auto sine = static_cast<float>(std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine))));
  EmittedPhoton photon;
  photon.ray.origin = light.position;
  photon.ray.direction =
      make_frame(light.direction).to_world(Vec3(sine * cos_sin(u.y), static_cast<float>(cosine)));
  photon.source_normal = photon.ray.direction;
  photon.flux_lm =
      static_cast<float>(spot_solid_angle_sr(light.cos_inner, light.cos_outer)) * light.intensity;
  return photon;
}

/// One path in kStray of the environment's is not aimed at the portals, so that no light is lost that comes
/// by another way. Each carries its light over the density with which both together draw its line (balance
/// heuristic; Veach 1997, 9.2.2), so that those on their way through a portal carry about alike.
EmittedPhoton Emitter::aimed(RandomStream& random) const {
  const Environment& light = *scene_->environment;
  const bool stray = random.uniform() < kStray;
  const float u_piece = random.uniform();
  const Vec2 u = random.uniform2(), u_place = random.uniform2();
  const Vec3 towards = stray ? light.sample_flux(u).direction : portals_->sample_direction(u);
  const Vec3 direction = -towards, centre = scene_->bounds.centre();
  const float radius_m = bounding_radius_m_;
  const Frame frame = make_frame(direction);
  Vec2 disc = radius_m * sample_disc(u_place);
  if (!stray) {
    Vec3 point;
    if (!portals_->sample_point(direction, u_piece, u_place, point)) return {};
    disc = {glm::dot(point - centre, frame.x), glm::dot(point - centre, frame.y)};
  }
  const Vec3 middle = centre + disc.x * frame.x + disc.y * frame.y;
  EmittedPhoton photon;
  photon.ray.origin = middle - 1.001f * radius_m * direction;
  photon.ray.direction = direction;
  photon.source_normal = direction;
  photon.from_infinity = true;
  const double disc_m2 = std::numbers::pi * static_cast<double>(radius_m) * static_cast<double>(radius_m);
  const bool within = glm::dot(disc, disc) <= radius_m * radius_m;
  const double by_aim = portals_->density(middle, direction);
  photon.astray = !(by_aim > 0);
  const double density = static_cast<double>(kStray) * (within ? light.flux_density(towards) / disc_m2 : 0) +
                         static_cast<double>(1 - kStray) * by_aim;
  if (density > 0) photon.flux_lm = Rgb(DVec3(light.luminance(towards)) / density);
  return photon;
}

EmittedPhoton Emitter::from_environment(RandomStream& random) const {
  if (portals_) return aimed(random);
  const Environment::Sample sample = scene_->environment->sample_flux(random.uniform2());
  if (!(sample.density > 0)) return {};
  return from_infinity(-sample.direction, sample.luminance / sample.density, random);
}

EmittedPhoton Emitter::from_infinity(const Vec3& direction, const Rgb& lux, RandomStream& random) const {
  const float radius_m = bounding_radius_m_;
  const Frame frame = make_frame(direction);
  const Vec2 disc = radius_m * sample_disc(random.uniform2());
  EmittedPhoton photon;
  // A thousandth of the radius before the sphere, so that surfaces that touch the sphere are not behind the
  // start.
  photon.ray.origin =
      scene_->bounds.centre() - 1.001f * radius_m * frame.z + disc.x * frame.x + disc.y * frame.y;
  photon.ray.direction = direction;
  photon.source_normal = direction;
  photon.from_infinity = true;
  photon.flux_lm = kPi * radius_m * radius_m * lux;
  return photon;
}

}  // namespace phos::inline photon
