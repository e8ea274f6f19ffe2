// Photons leaving the lights.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.h"
#include "photon/portals.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"

namespace phos::inline photon {

struct EmittedPhoton {
  Ray ray;
  Rgb flux_lm{0};
  Vec3 source_normal{
      0, 0, 1};  ///< geometric, on the side it left; the flight direction where the light has no surface
  bool from_infinity = false;  ///< directional light or environment
  bool astray = false;         ///< not aimed at the scene's portals, and its line crosses none of them
};

/// Emits path 0 .. paths-1 of a run. What a path starts with depends on its number and the seed alone.
class Emitter {
 public:
  /// Each light gets a share of the paths in proportion to its flux, but at least minimum_share / (number of
  /// lights). Throws Error(bad_input) if no light shines. Where the scene has portals, nine in ten paths of
  /// the environment are aimed at them, and its flux counts as the flux that comes through them.
  Emitter(const Scene& scene, double minimum_share, std::uint64_t paths, std::uint64_t seed);

  /// The light that a path starts from. Lights are dealt by a van der Corput sequence with a random start:
  /// after any number of paths each light has had its share to within a few paths, so that the choice adds no
  /// noise.
  std::size_t light_of(std::uint64_t path) const;
  const Light& light(std::uint64_t path) const { return luminaires_[light_of(path)]; }
  const MirrorPlanes& mirrors() const { return luminaires_.mirrors(); }
  /// Probability of a light.
  double share(std::size_t light) const { return share_[light]; }

  /// Starts a path; draws from `random` (the path's stream at bounce 0). The expected sum over all paths is
  /// the flux of every light.
  EmittedPhoton emit(std::uint64_t path, RandomStream& random) const;
  /// 1 / (share of a light x all paths): the factor on the flux of a photon that carries all flux of a light.
  float scale(std::size_t light) const { return scale_[light]; }
  /// About the luminous flux of a photon that is aimed at the portals, lm; 0: there are none.
  double aimed_lm() const;

  /// Exponent of FluxSum units for this run: total flux is 2^46 units, which leaves room for 2^16 bounces.
  int flux_exponent() const { return flux_exponent_; }

 private:
  EmittedPhoton start(std::size_t i, RandomStream& random) const;
  EmittedPhoton from_area(std::size_t i, RandomStream& random) const;
  EmittedPhoton from_opening(std::size_t i, RandomStream& random) const;
  EmittedPhoton from_measured(const Light& light, RandomStream& random) const;
  EmittedPhoton from_point(const Light& light, RandomStream& random) const;
  EmittedPhoton from_spot(const Light& light, RandomStream& random) const;
  EmittedPhoton from_environment(RandomStream& random) const;
  EmittedPhoton aimed(RandomStream& random) const;
  EmittedPhoton from_infinity(const Vec3& direction, const Rgb& lux, RandomStream& random) const;

  const Scene* scene_;
  std::optional<Portals> portals_;
  Luminaires luminaires_;
  std::uint64_t rotation_ = 0;
  std::vector<double> share_;
  std::vector<float> scale_;  // of a photon of light i, for its share of the paths
  std::vector<std::uint64_t>
      last_;  // light i takes the ticks up to and including last_[i], after the tickets of i-1
  float bounding_radius_m_ = 0;
  int flux_exponent_ = 0;
};

/// Spot light of glTF (KHR_lights_punctual): intensity falls from I at cos_inner to 0 at cos_outer as the
/// square of a linear ramp in the cosine. Solid angle by which I gives the flux, sr.
double spot_solid_angle_sr(double cos_inner, double cos_outer);
/// Cosine to the axis with density proportional to the intensity.
double sample_spot_cosine(double cos_inner, double cos_outer, float u);

}  // namespace phos::inline photon
