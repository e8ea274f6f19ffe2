#include "reference/light_path.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "reference/limits.h"
#include "reference/roulette.h"
#include "scene/material/models.h"
#include "scene/material/passage.h"
#include "scene/material/sharp_materials.h"
#include "scene/material/total_reflections.h"

namespace phos::inline reference {

/// The edge that is gone along, and the vertex it began at.
struct LightTracer::Walk {
  LightStarts::Start lamp;
  Ray ray;
  Rgb flux{0};
  double density = 0;                  // of the direction, per sr
  double cos_leaving = 1;              // where it began
  double behind = 0;                   // U + rho V there
  std::int32_t scatterings = 0;        // so far
  std::int32_t events = 0;             // scatterings and panes passed
  bool mirror = false, sharp = false;  // how it was scattered there
  bool straight = false, ends = false;
  TotalReflections total_reflections;
  // At the surface that was met.
  SubPathEnd end;
  float landed_m = 0;  // along the edge
};

LightTracer::LightTracer(const RayScene& rays, const Luminaires& luminaires, const LightStarts& lamps,
                         const PathOptions& options)
    : rays_(&rays), luminaires_(&luminaires), lamps_(&lamps), options_(options) {}

/// The numbers of a vertex, and the vertex itself where it can be connected.
bool LightTracer::meet(const SurfacePoint& point, const Bsdf& bsdf, double eta, Walk& walk,
                       LightPaths& paths) const {
  const Vec3& d = walk.ray.direction;
  const double cosine = std::fabs(static_cast<double>(glm::dot(d, point.geometric_normal)));
  const double distance = static_cast<double>(point.distance_m);
  if (!(cosine > 0) || !(distance > 0)) return false;
  double every_light = 1;
  walk.end = SubPathEnd();
  if (walk.scatterings == 0) {
    const LightStarts::Start& lamp = walk.lamp;
    const double choice = lamps_->share(lamp.light), cos_lamp = static_cast<double>(lamp.cos_lamp);
    every_light = 1 / choice;
    // Densities at the lamp are of the place per m2, or of the direction per sr. The factor cos_lamp / d^2,
    // which they share with the densities of shadow rays, is cancelled.
    const double own = lamp.density * cosine;
    if (lamp.infinite)
      walk.end.connect =
          choice *
          (lamp.extended ? static_cast<double>(luminaires_->density_beyond(point.position, -d)) : 1) / own;
    else if (lamp.extended)
      walk.end.connect = choice *
                         static_cast<double>(luminaires_->density(lamp.light, point.position, lamp.triangle,
                                                                  point.distance_m, lamp.cos_lamp)) *
                         cos_lamp / own;
    else
      walk.end.connect = choice * distance * distance / own;
    if (lamp.extended) walk.end.before = (lamp.infinite ? 1 : cos_lamp) / own;
  } else {
    const double across = walk.density * cosine;  // f d^2
    if (!walk.mirror) walk.end.connect = distance * distance / across;
    walk.end.before = walk.cos_leaving / across * walk.behind;
  }
  if (!std::isfinite(walk.end.connect) || !std::isfinite(walk.end.before)) return false;
  if (paths.segments_only || !bsdf.scatters()) return true;
  const bool sharp = reflects_sharply(rays_->scene().material[point.material]);
  const bool merges = walk.sharp && (bsdf.has_diffuse() || bsdf.transmits_diffusely() || !sharp);
  if (merges) walk.end.merge = eta;
  paths.vertex.push_back(
      {point, bsdf, -d, walk.flux, walk.end, every_light, walk.scatterings, merges, sharp});
  return true;
}

/// False where the path ends.
bool LightTracer::scatter(const SurfacePoint& point, const Bsdf& bsdf, Walk& walk,
                          RandomStream& random) const {
  const Vec3 wo = -walk.ray.direction;
  random.start_bounce(static_cast<std::uint32_t>(walk.events));
  const float u_lobe = random.uniform();
  BsdfSample next;
  if (!bsdf.sample(wo, u_lobe, random.uniform2(), next, TransportMode::flux)) return false;
  ++walk.events;
  walk.flux *= next.weight;
  walk.straight = next.straight;
  if (!(max_component(walk.flux) > 0) || walk.events >= kMostEvents.most) return false;
  if (next.straight) return true;
  ++walk.scatterings;
  if (options_.bounces >= 0 && walk.scatterings >= options_.bounces) return false;
  walk.mirror = next.specular;
  walk.sharp = next.specular || reflects_sharply(rays_->scene().material[point.material]);
  walk.density = next.specular ? 1 : static_cast<double>(next.density);
  walk.cos_leaving = std::fabs(static_cast<double>(glm::dot(next.direction, point.geometric_normal)));
  const double back = next.specular ? 1 : static_cast<double>(bsdf.density(next.direction, wo));
  walk.behind = walk.end.next_before(1, back, next.specular);
  walk.ray = {point.leave(next.direction), next.direction, 0, kInfinity};
  const float share = max_component(walk.flux) / max_component(walk.lamp.flux_lm);
  const float in_glass = walk.total_reflections.survival(bsdf.total_reflection(wo));
  return survives(walk.scatterings, std::min(share, in_glass), random, walk.flux);
}

void LightTracer::trace(RandomStream& random, double eta, LightPaths& paths) const {
  Walk walk;
  random.start_bounce(kStartBounce);
  if (lamps_->start(random, walk.lamp) && options_.bounces != 0) {
    walk.ray = walk.lamp.ray;
    walk.flux = walk.lamp.flux_lm;
    for (bool goes_on = true; goes_on;) {
      Way way(*rays_, walk.ray);
      SurfacePoint point;
      float before_m = 0;
      do {
        const bool met = way.next(point);
        // No sensor is in solid glass.
        const bool in_glass = met && !point.front && is_solid_glass(rays_->scene().material[point.material]);
        if (walk.sharp && !in_glass) {
          SharpSegment s{walk.ray.origin + before_m * walk.ray.direction,
                         walk.ray.direction,
                         met ? point.distance_m - before_m : kInfinity,
                         before_m,
                         met ? point.error_m : 0,
                         walk.flux,
                         walk.density,
                         walk.cos_leaving,
                         walk.behind,
                         walk.scatterings,
                         walk.mirror};
          paths.segment.push_back(s);
        }
        if (!met) {
          goes_on = false;
          break;
        }
        before_m = point.distance_m;
        const Bsdf bsdf = way.bsdf(point);
        if (options_.black_emitters && rays_->scene().material[point.material].emits()) {
          goes_on = false;
          break;
        }
        walk.straight = false;
        goes_on = meet(point, bsdf, eta, walk, paths) && scatter(point, bsdf, walk, random);
      } while (goes_on && walk.straight);
    }
  }
  paths.first.push_back(static_cast<std::uint32_t>(paths.vertex.size()));
}

LightPaths trace_light(const LightTracer& tracer, std::uint64_t seed, std::uint64_t item, std::size_t paths,
                       double eta, bool segments_only) {
  constexpr std::size_t kChunk = 256;
  LightPaths all;
  all.first.push_back(0);
  all.segments_only = segments_only;
  return parallel_reduce(
      paths, kChunk, std::move(all),
      [&](std::size_t begin, std::size_t end) {
        LightPaths part;
        part.segments_only = segments_only;
        for (std::size_t i = begin; i < end; ++i) {
          RandomStream random(seed, Stage::reference, item + i);
          tracer.trace(random, eta, part);
        }
        return part;
      },
      [](LightPaths& sum, const LightPaths& part) {
        const auto before = static_cast<std::uint32_t>(sum.vertex.size());
        sum.vertex.insert(sum.vertex.end(), part.vertex.begin(), part.vertex.end());
        sum.segment.insert(sum.segment.end(), part.segment.begin(), part.segment.end());
        for (const std::uint32_t end : part.first) sum.first.push_back(before + end);
      });
}

}  // namespace phos::inline reference
