#include "photon/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "photon/limits.h"
#include "scene/material/models.h"
#include "scene/material/passage.h"
#include "scene/mirror/images.h"

namespace phos::inline photon {
namespace {

constexpr auto kMaxBounces =
    kMostPhotonEvents.as<std::uint32_t>();  // the last that a random stream can number

// Without the not-a-number rules of fmax, which cost a call.
float largest(const Rgb& c) { return std::max(c.x, std::max(c.y, c.z)); }

/// Numbers a child's random stream (Steele et al. 2014, SplitMix64).
std::uint64_t mixed(std::uint64_t path, std::uint32_t event, std::size_t child) {
  std::uint64_t z = path + 0x9e3779b97f4a7c15u * ((std::uint64_t{event} << 32 | child) + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (z ^ (z >> 31)) | std::uint64_t{1} << 63;  // apart from the streams of parents
}

}  // namespace

PathTracer::PathTracer(const RayScene& rays, const Emitter& emitter, const CausticAim* aim,
                       std::uint64_t paths, std::uint64_t aimed_paths, std::uint64_t seed, bool log)
    : rays_(rays),
      emitter_(emitter),
      mirrors_(emitter.mirrors()),
      aim_(aim),
      paths_(paths),
      aimed_paths_(aimed_paths),
      seed_(seed),
      log_(log),
      units_per_lm_(std::ldexp(1.0, -emitter.flux_exponent())) {
  const std::vector<Portal>& portals = rays.scene().portal;
  if (emitter.aimed_lm() > 0) split_.emplace(portals, emitter.aimed_lm());
}

std::pair<std::uint64_t, std::uint64_t> PathTracer::aimed_with(std::uint64_t path) const {
  if (!aim_) return {0, 0};
  const auto until = [&](std::uint64_t p) {
    return static_cast<std::uint64_t>(static_cast<double>(p) / static_cast<double>(paths_) *
                                      static_cast<double>(aimed_paths_));
  };
  return {until(path), path + 1 == paths_ ? aimed_paths_ : until(path + 1)};
}

void PathTracer::trace(std::uint64_t path, PathPart& part) const {
  RandomStream random = stream(path);
  if (Flight flight; start(path, random, flight, part)) follow(flight, random, part);
  const auto [first, last] = aimed_with(path);
  for (std::uint64_t i = first; i < last; ++i) {
    RandomStream own = aimed_stream(i);
    if (Flight flight; start_aimed(i, own, flight, part)) follow(flight, own, part);
  }
}

bool PathTracer::start(std::uint64_t path, RandomStream& random, Flight& flight, PathPart& part) const {
  random.start_bounce(0);
  const EmittedPhoton start = emitter_.emit(path, random);
  if (!is_finite(start.flux_lm)) {
    ++part.sums.non_finite;
    return false;
  }
  flight.ray = start.ray, flight.flux_lm = start.flux_lm, flight.units = units(start.flux_lm);
  flight.source_normal = start.source_normal, flight.from_infinity = start.from_infinity;
  flight.mirrored = !mirrors_.empty() && is_of_image(emitter_.light(path), start.ray.direction);
  part.sums.emitted += flight.units;
  if (aim_) flight.keep = Flight::Keep::others;
  flight.number = path;
  if (split_ && start.astray) flight.astray = Flight::Astray::parent;
  return carries_light(flight);
}

bool PathTracer::start_aimed(std::uint64_t number, RandomStream& random, Flight& flight,
                             PathPart& part) const {
  random.start_bounce(0);
  const std::size_t light = emitter_.light_of(number);
  CausticAim::Start start = aim_->start(light, random);
  const double per_path = static_cast<double>(paths_) / static_cast<double>(aimed_paths_);
  start.photon.flux_lm *= emitter_.scale(light) * static_cast<float>(per_path);
  if (!is_finite(start.photon.flux_lm)) {
    ++part.aimed.non_finite;
    return false;
  }
  flight.ray = start.photon.ray, flight.flux_lm = start.photon.flux_lm;
  flight.units = units(flight.flux_lm);
  flight.source_normal = start.photon.source_normal, flight.from_infinity = start.photon.from_infinity;
  flight.mirrored = !mirrors_.empty() && is_of_image(emitter_.light(number), start.photon.ray.direction);
  flight.keep = Flight::Keep::caustics, flight.aimed_at = start.triangle;
  flight.number = ~number;  // apart from those of paths that are not aimed
  return carries_light(flight);
}

void PathTracer::follow(Flight& flight, RandomStream& random, PathPart& part) const {
  while (carries_light(flight) && step(flight, random, part)) {
  }
}

PathTracer::Draws PathTracer::depart(Flight& flight, RandomStream& random, PathPart& part) const {
  if (log_) part.rays.push_back(flight.ray);
  flight.stretch_from = flight.ray.origin;
  random.start_bounce(flight.events + 1);
  const float lobe = random.uniform();
  return {lobe, random.uniform2()};
}

/// To the next surface and off it again; straight through panes on the way. False: the photon is no more.
bool PathTracer::step(Flight& flight, RandomStream& random, PathPart& part) const {
  Way way(rays_, flight.ray);
  Draws draws = depart(flight, random, part);
  for (;;) {
    SurfacePoint point;
    const bool met = way.next(point);
    if (flight.astray != Flight::Astray::no && (met ? point.distance_m : kInfinity) > flight.portal_m) {
      // Other photons carry this light.
      if (flight.astray == Flight::Astray::parent) return part.sums.absorbed += flight.units, false;
      flight.astray = Flight::Astray::no;
    }
    if (!met && flight.astray == Flight::Astray::child) return part.sums.absorbed += flight.units, false;
    if (!met) return escape(flight, part), false;
    const After after = land(point, way.bsdf(point), draws, flight, random, part);
    if (after != After::passed) return after == After::scattered;
    random.start_bounce(flight.events + 1);
    draws.lobe = random.uniform(), draws.direction = random.uniform2();
  }
}

void PathTracer::escape(const Flight& flight, PathPart& part) const {
  note_flight(part.photons.flights, flight, kInfinity);
  sums(flight, part).escaped += flight.units;
  ++sums(flight, part).escaped_paths;
}

PathTracer::After PathTracer::land(const SurfacePoint& point, const Bsdf& bsdf, const Draws& draws,
                                   Flight& flight, RandomStream& random, PathPart& part) const {
  // What is not through a portal yet, the parent tells of.
  const bool before_portal = flight.astray == Flight::Astray::child;
  PathSums& own = sums(flight, part);
  if (before_portal) {
  } else if (bsdf.takes_light()) {
    if (flight.tells()) {
      store(part.photons, flight, point);
      if (split_) part.photons.family.push_back(static_cast<std::uint32_t>(flight.number));
      own.stored += flight.units;
    }
  } else {
    note_flight(part.photons.flights, flight, glm::distance(flight.stretch_from, point.position));
  }
  flight.stretch_from = point.position;
  own.absorbed += flight.units;
  const After after = scatter(bsdf, point, draws, flight, random, part);
  if (after == After::ended || (before_portal && after != After::passed)) return After::ended;
  flight.units = units(flight.flux_lm);
  own.absorbed -= flight.units;
  return after;
}

/// Light of a lamp that has images in flat mirrors; of an environment, of its sun.
bool PathTracer::is_of_image(const Light& light, const Vec3& direction) const {
  const Scene& scene = rays_.scene();
  if (light.kind != Light::Kind::environment) return has_images(scene, light);
  return sun_luminance(scene, -direction) != Rgb(0);
}

/// Samples the material and plays Russian roulette.
PathTracer::After PathTracer::scatter(const Bsdf& bsdf, const SurfacePoint& point, const Draws& draws,
                                      Flight& flight, RandomStream& random, PathPart& part) const {
  if (flight.events == kMaxBounces) {
    ++sums(flight, part).too_long;
    return After::ended;
  }
  ++flight.events;
  const Vec3 wo = -flight.ray.direction;
  if (flight.astray == Flight::Astray::parent) send_through_portals(bsdf, point, wo, flight, part);
  BsdfSample sample;
  if (!bsdf.sample(wo, draws.lobe, draws.direction, sample, TransportMode::flux)) return After::ended;
  const Rgb flux = sample.weight * flight.flux_lm;
  if (!is_finite(flux)) {
    ++sums(flight, part).non_finite;
    return After::ended;
  }
  const float in_glass = flight.total_reflections.survival(bsdf.total_reflection(wo));
  const float survival = std::min(in_glass, largest(flux) / largest(flight.flux_lm));
  if (!(survival > 0) || (survival < 1 && random.uniform() >= survival)) {
    sums(flight, part).kept_in_glass += in_glass < 1;
    return After::ended;
  }
  flight.flux_lm = (1 / survival) * flux;
  if (sample.straight) return After::passed;
  if (aim_ && flight.bounce == 0) {
    flight.aimed_class = aim_->takes(point.material);
    if (flight.keep == Flight::Keep::caustics && point.triangle != flight.aimed_at) return After::ended;
  }
  if (flight.keep == Flight::Keep::caustics && !sample.specular) return After::ended;
  ++flight.bounce;
  flight.ray = Ray{point.leave(sample.direction), sample.direction};
  flight.source_normal = glm::dot(sample.direction, point.geometric_normal) >= 0 ? point.geometric_normal
                                                                                 : -point.geometric_normal;
  flight.from_infinity = false;
  // What mirrors and glass send on has no children.
  if (flight.astray == Flight::Astray::parent)
    flight.portal_m =
        sample.specular ? kInfinity : split_->first_crossing_m(point.position, sample.direction);
  flight.specular_only = flight.specular_only && sample.specular;
  if (flight.mirrored) {
    const bool reflected = sample.specular && !sample.transmitted;
    flight.chain =
        reflected ? mirrors_.follow(flight.chain, point.triangle, point.front) : MirrorPlanes::kNone;
    flight.mirrored = flight.chain != MirrorPlanes::kNone;
  }
  const bool ahead = glm::dot(sample.direction, point.geometric_normal) >= 0;
  flight.in_glass = is_solid_glass(rays_.scene().material[point.material]) && ahead != point.front;
  return After::scattered;
}

/// The children of a flight astray that has met a surface.
void PathTracer::send_through_portals(const Bsdf& bsdf, const SurfacePoint& point, const Vec3& wo,
                                      const Flight& parent, PathPart& part) const {
  RandomStream random(seed_, Stage::through_portal, parent.number);
  random.start_bounce(parent.events);
  std::vector<PortalSplit::Child> children;
  split_->children(point, bsdf, wo, parent.flux_lm, random, children);
  for (std::size_t i = 0; i < children.size(); ++i) {
    Flight child = parent;
    child.flux_lm *= children[i].weight;
    if (!is_finite(child.flux_lm)) {
      ++part.sums.non_finite;
      continue;
    }
    child.units = units(child.flux_lm);
    child.ray = Ray{point.leave(children[i].direction), children[i].direction};
    child.source_normal = glm::dot(children[i].direction, point.geometric_normal) >= 0
                              ? point.geometric_normal
                              : -point.geometric_normal;
    child.from_infinity = child.specular_only = child.mirrored = child.in_glass = false;
    child.chain = MirrorPlanes::kNone;
    child.total_reflections = {};
    ++child.bounce;
    child.astray = Flight::Astray::child;
    child.portal_m = split_->first_crossing_m(point.position, children[i].direction);
    // Of the light that the surface took.
    part.sums.absorbed -= child.units;
    RandomStream own(seed_, Stage::through_portal, mixed(parent.number, parent.events, i));
    follow(child, own, part);
  }
}

}  // namespace phos::inline photon
