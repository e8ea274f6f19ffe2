// Light straight from the lamps where rays land: samples of one lamp each.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "direct/light_tree.h"
#include "scene/lamp/luminaires.h"
#include "scene/lamp/panel.h"
#include "scene/rays.h"

namespace phos::inline direct {

/// A sample of the light that a diffuse point receives from the lamps.
struct ArrivingLight {
  Rgb lux{0};            ///< cosine, density and the choice of the lamp included; 0: none
  Ray ray;               ///< it arrives unless something is in the way of this one
  bool certain = false;  ///< it is known to arrive: no need to look
};

/// Chooses one lamp for a point, with a probability about in proportion to the light that it would bring if
/// nothing stood between: of more than eight that stand somewhere, by their hierarchy (LightTree). A lamp
/// that could light the point is never left out. Const, usable from any thread; holds references.
class LampSampler {
 public:
  LampSampler(const RayScene& rays, const Luminaires& lights);

  /// How many samples at a place pay, their choices of a lamp stratified: about as many as there are lamps of
  /// like power (the exponential of the entropy of their shares), and at most four. Which lamp is chosen is
  /// most of the noise where there are several. 1 for one lamp, or none.
  std::uint32_t samples() const { return samples_; }

  struct Choice {
    std::size_t light = 0;
    float probability = 1;
    float rest = 0;  ///< the rest of `u`: uniform in [0, 1) given the light
  };
  /// `u` in [0, 1). There must be a light.
  Choice choose(const SurfacePoint& point, float u) const;
  /// Probability with which choose() takes that light.
  float probability(const SurfacePoint& point, std::size_t light) const;

  /// One sample, from three numbers in [0, 1). Unbiased, of bounded variance for area lights however near:
  /// close to one, some samples are cosine-weighted rays that may find it (balance heuristic, Veach 1997
  /// ch. 9).
  /// The result is filled in place: copies were a tenth of the cost.
  void sample(const SurfacePoint& point, const std::array<float, 3>& u, ArrivingLight& light) const;

 private:
  /// Up to so many lamps are compared at the point itself.
  static constexpr std::size_t kMostCompared = 8;
  struct Lamp {
    Light::Kind kind = Light::Kind::point;
    Vec3 centre{0};      // directional: unused
    Vec3 front{0};       // where a spot, a directional or a plane one-sided lamp shines to; else 0
    float radius_m = 0;  // of the sphere about an area light
    float strength = 0;  // intensity towards the front, cd; directional: lx
    Light beam;          // of a spot or measured light: itself
  };
  using Promises = std::array<float, kMostCompared>;
  static Lamp lamp_of(const Scene& scene, const Light& light);
  float promise_lx(const Lamp& lamp, const SurfacePoint& point) const;
  float promises(const SurfacePoint& point, Promises& each) const;
  float ray_share(const SurfacePoint& point) const;
  void by_ray(const SurfacePoint& point, const Vec2& u, float ray_share, ArrivingLight& light) const;

  /// Of many lamps: with which the tree is asked, and not the ones that are far.
  double tree_share(const SurfacePoint& point, std::vector<double>& far_lx) const;
  Choice choose_of_many(const SurfacePoint& point, float u) const;
  float probability_of_many(const SurfacePoint& point, std::size_t light) const;

  const RayScene& rays_;
  const Luminaires& lights_;
  std::vector<Lamp> lamp_;         // empty where there are too many
  std::optional<LightTree> tree_;  // of those
  std::vector<std::size_t> far_;   // beside it: directional lights, and the environment
  std::vector<Lamp> far_lamp_;
  std::vector<LampPanel> panel_;  // per light
  std::vector<float> share_;      // of power
  std::vector<double> cdf_;
  bool area_ = false;  // any is an area light
  std::uint32_t samples_ = 1;
};

}  // namespace phos::inline direct
