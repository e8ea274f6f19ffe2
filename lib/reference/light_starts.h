// Rays that start at lamps, with their joint densities: the light ends of bidirectional paths.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"

namespace phos::inline reference {

/// Draws a lamp, a place on it and a direction. Half of the rays are aimed at surfaces that cast caustics,
/// where these are small: spheres about the instances that reflect or refract sharply. Const and usable from
/// any thread; holds references.
class LightStarts {
 public:
  LightStarts(const Scene& scene, const Luminaires& luminaires);

  struct Start {
    Ray ray;
    Rgb flux_lm{0};      ///< luminance x cosine (or intensity, or illuminance) over `density`
    double density = 0;  ///< joint: of lamp, place and direction (see density())
    std::size_t light = 0;
    std::uint32_t triangle = 0;  ///< of an area light
    float cos_lamp = 1;          ///< to the normal of an area light
    bool infinite = false;       ///< directional light or environment
    bool extended = false;       ///< can be hit by chance: area light or environment
  };
  /// False where nothing leaves that way. The expected flux is the flux of all lamps.
  bool start(RandomStream& random, Start& result) const;

  /// Density of start() for the ray along `direction` (unit, the way light travels) from `place` of light i
  /// (area light: on `triangle`, whose unit normal on the side it leaves is `normal`; infinitely far ones:
  /// any point of the ray). Area light: per m2 and sr. Point, spot, measured: per sr. Environment: per sr
  /// and m2 across the ray. Directional: per m2.
  double density(std::size_t i, const Vec3& place, std::uint32_t triangle, const Vec3& normal,
                 const Vec3& direction) const;

  /// Probability of each light, in start() and wherever one light is chosen.
  double share(std::size_t i) const { return share_[i]; }
  std::size_t choose_light(double u) const;
  bool none() const { return share_.empty(); }

 private:
  struct Target {
    DVec3 centre;
    double radius_m;
  };
  void find_targets();
  bool aim(const Vec3& place, RandomStream& random, Vec3& direction) const;
  double lobe_density(std::size_t i, const Vec3& normal, const Vec3& direction) const;
  Vec3 sample_lobe(const Light& light, const Vec3& normal, RandomStream& random) const;
  double across_density(const Vec3& place, const Vec3& direction) const;
  Vec3 sample_across(const Vec3& direction, RandomStream& random) const;
  bool start_at_infinity(const Light& light, RandomStream& random, Start& result) const;
  bool start_near(const Light& light, RandomStream& random, Start& result) const;
  bool start_at_opening(const Light& light, RandomStream& random, Start& result) const;

  const Scene* scene_;
  const Luminaires* luminaires_;
  std::vector<double> share_, cdf_;
  std::vector<Target> target_;
  double radius_m_ = 0;
};

}  // namespace phos::inline reference
