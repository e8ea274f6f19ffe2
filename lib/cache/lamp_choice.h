// Which lamp a place where a ray landed looks at.
#pragma once

#include <array>
#include <vector>

#include "scene/luminaires.h"

namespace phos {

/// Chooses one lamp for a point, with a probability about in proportion to the light that it would bring if
/// nothing stood between; in proportion to power where there are many. A lamp that could light the point is
/// never left out.
class LampChoice {
 public:
  LampChoice(const Scene& scene, const Luminaires& lights);

  struct Choice {
    std::size_t light = 0;
    float probability = 1;
    float rest = 0;  ///< what `u` has left: uniform in [0, 1) given the light
  };
  /// `u` in [0, 1). There must be a light.
  Choice choose(const SurfacePoint& point, float u) const;
  /// Probability with which choose() takes that light.
  float probability(const SurfacePoint& point, std::size_t light) const;

 private:
  /// Up to so many lamps are compared at the point itself.
  static constexpr std::size_t kMostCompared = 8;
  struct Lamp {
    Light::Kind kind = Light::Kind::point;
    Vec3 centre{0};      // directional: unused
    Vec3 front{0};       // where a spot, a directional or a plane one-sided lamp shines to; else 0
    float radius_m = 0;  // of the sphere about an area light
    float strength = 0;  // intensity towards the front, cd; directional: lx
    Light spot;          // of a spot: its cone
  };
  using Promises = std::array<float, kMostCompared>;
  static Lamp lamp_of(const Scene& scene, const Light& light);
  static float promise_lx(const Lamp& lamp, const SurfacePoint& point);
  float promises(const SurfacePoint& point, Promises& each) const;

  std::vector<Lamp> lamp_;    // empty where there is one only, or too many
  std::vector<float> share_;  // of power
  std::vector<double> cdf_;
};

}  // namespace phos
