// Light along one path, backwards from the eye or a sensor: unbiased, of any length.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/random.h"
#include "core/vector.h"
#include "scene/lamp/luminaires.h"
#include "scene/material/bsdf.h"
#include "scene/rays.h"

namespace phos::inline reference {

struct PathOptions {
  /// Scatterings between a light and the eye, the one at the visible surface (or sensor) included: 0 =
  /// emission only, 1 = direct light, 2 = one indirect bounce; negative = all of them (paths end by Russian
  /// roulette alone).
  std::int64_t bounces = -1;
  /// Surfaces that emit reflect nothing (a convention of some other renderers).
  bool black_emitters = false;
};

/// One sample of the luminance along a camera ray, cd/m2, by the way it came. The parts do not overlap.
struct PathSample {
  Rgb emission{0};  ///< of the visible surface itself, or of the environment where there is none
  Rgb direct{0};    ///< from a light, scattered once, at the visible surface
  /// Scattered twice or more, last by the Lambert part of a visible surface, or by its glossy part.
  Rgb indirect{0}, glossy{0};
  Rgb specular{0};  ///< all light seen in a mirror or through glass
  Rgb total() const { return emission + direct + indirect + glossy + specular; }
};

/// Light passes straight through panes, which is no scattering: shadow rays go on through them.
///
/// Path tracing with next-event estimation and multiple importance sampling (power heuristic) after Veach
/// 1997, chapters 9 and 10, and Russian roulette by throughput. Const and usable from any thread; holds
/// references.
class EyePathTracer {
 public:
  EyePathTracer(const RayScene& rays, const Luminaires& luminaires, const PathOptions& options = {});

  /// Luminance arriving along a ray, cd/m2. Draws from `random`, bounce by bounce.
  PathSample luminance(const Ray& ray, RandomStream& random) const;

  /// Irradiance on the side of sensor.geometric_normal, lx (the normal and error_m alone are used, no
  /// material).
  Rgb irradiance(const SurfacePoint& sensor, RandomStream& random) const;

  /// Light straight from lamps (panes and images in flat mirrors included) by shadow rays alone, without
  /// multiple importance sampling: the integral of luminance times `f_cos`(direction towards it).
  Rgb direct(const SurfacePoint& point, const std::function<Rgb(const Vec3&)>& f_cos,
             RandomStream& random) const;

 private:
  struct Walk;
  template <class Scatter>
  Rgb light_at(const SurfacePoint& point, bool every_light, const Scatter& scatter,
               RandomStream& random) const;
  Rgb emission_at(const SurfacePoint& point, const Walk& walk) const;
  Rgb emission_beyond(const Walk& walk) const;
  std::int32_t image_chain(const Walk& walk) const;
  static void add_emission(const Rgb& luminance, const Walk& walk, PathSample& sum);
  static void add_indirect(const Rgb& light, const Walk& walk, PathSample& sum);
  enum class Next : std::uint8_t { none, ray, straight };
  Next scatter(const SurfacePoint& point, const Bsdf& bsdf, bool lit, Walk& walk, PathSample& sum,
               RandomStream& random) const;
  void note_mirror(const SurfacePoint& point, const BsdfSample& next, Walk& walk) const;
  void follow(Walk walk, PathSample& sum, RandomStream& random) const;
  bool sample_every_light(std::int64_t scatterings) const;

  const RayScene* rays_;
  const Luminaires* luminaires_;
  PathOptions options_;
  std::vector<float> share_;  // of the one-light choice
  std::vector<double> cdf_;
};

}  // namespace phos::inline reference
