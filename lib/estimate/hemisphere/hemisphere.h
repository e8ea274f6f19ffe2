// The light that a record's rays met: a sampled hemisphere, and the quantities that follow from it.
#pragma once

#include <span>
#include <vector>

#include "core/vector.h"
#include "estimate/zone/gradients.h"

namespace phos::inline estimate {

/// What the cells of a stratified hemisphere hold equal shares of.
enum class Measure {
  projected,  ///< projected solid angle (cosine included): irradiance; sin^2(theta) in [j, j+1) / rings
  solid,      ///< solid angle: radiance; 1 - cos(theta) in [j, j+1) / rings
};

/// Noise of the light that rays read where they land, which more rays do not take away: neighbouring rays,
/// and neighbouring places, read the same. Sums over the rays of a hemisphere. The light that comes from a
/// source made of photons is white noise over its surfaces: of radiance f E towards the place (f reflectance
/// over pi), the part of variance f^2 E phi cos / (d^2 + z^2) per solid angle, where phi is the flux of one
/// photon, cos and d belong to the surface, and z^2 is half of the squared radius of a zone of the source.
struct SourceNoise {
  DVec3 irradiance{0};       ///< lx, of the light that was read
  DVec3 variance{0};         ///< of that, lx^2
  DVec3 per_coefficient{0};  ///< of a coefficient of radiance, in orthonormal harmonics, (cd/m2)^2 sr
  double common = 0;         ///< relative variance that all of the source has in common (PhotonNoise::common)

  /// The whole variance of irradiance, lx^2, never below 0.
  DVec3 total() const { return glm::max(variance + common * irradiance * irradiance, DVec3(0)); }
};

/// Noise of the places on lamps that light the hits of the rays, were each by itself: a sum over the rays.
/// Together they are even (HitLight::shade), and leave less of it.
struct LampNoise {
  DVec3 variance{0};   ///< of radiance, (cd/m2)^2
  double squares = 0;  ///< of the rays' own parts of that, luminance: (cd/m2)^4

  /// The difference of radiance by two places that have nothing in common, found at one ray of `stands_for`.
  void add(const Rgb& difference, double stands_for);
  /// Of the variance of the sum of radiance over the rays, as differences between strata tell it, times
  /// weight2 (the mean square of the rays' weights): the part that even places leave. `parts` of the sum are
  /// weighed with unlike signs: each has its share of the places.
  DVec3 left_of(const DVec3& strata, double weight2, std::size_t rays, double parts = 1) const;
};

/// Rays of one hemisphere, as columns. Stratified: rings x slices cells of equal measure, one ray in each,
/// ray(j, k) = j * slices + k, theta by the measure, phi in [k, k+1) 2 pi/slices about frame.z from frame.x.
/// Unstructured (a raster): rings = slices = 0, any directions.
struct Hemisphere {
  Frame frame;
  int rings = 0, slices = 0;
  Measure measure = Measure::projected;
  std::vector<Vec3> direction;    ///< world, unit, above frame.z
  std::vector<Rgb> radiance;      ///< cd/m2 arriving along it
  std::vector<float> distance_m;  ///< infinity: it escaped
  std::vector<Vec3> hit_normal;   ///< unit, on the side it hit; minus direction where there is none
  std::vector<float>
      projected_sr;    ///< projected solid angle that it stands for (cosine included); all sum to pi
  SourceNoise source;  ///< none, unless HitLight::shade() has set it
  LampNoise lamps;     ///< noise of the lamps' places
  std::size_t size() const { return direction.size(); }
  bool stratified() const { return rings > 0; }
  /// Solid angle that a ray stands for; all sum to 2 pi.
  float solid_sr(std::size_t i) const {
    if (stratified() && measure == Measure::solid) return 2 * kPi / static_cast<float>(size());
    return projected_sr[i] / glm::dot(direction[i], frame.z);
  }
  /// Of a cell; `slice` goes round, at most once.
  std::size_t at(int ring, int slice) const {
    const int around = slice < 0 ? slice + slices : slice >= slices ? slice - slices : slice;
    return static_cast<std::size_t>(ring * slices + around);
  }
  void resize(std::size_t n) {
    direction.resize(n), radiance.resize(n), distance_m.resize(n), hit_normal.resize(n),
        projected_sr.resize(n);
  }
};

/// Slices to so many rings, round(pi rings): cells are about square (Ward and Heckbert 1992).
int slices_for(int rings);
/// Cells of so many rings, and so the rays of a stratified hemisphere: rings x slices_for(rings).
std::int64_t cells_of(int rings);
/// Most rings (at least one) with no more cells than `rays`.
int rings_for(std::int64_t rays);

/// E = sum of radiance x projected solid angle, lx; in double, in order.
Rgb irradiance_of(const Hemisphere& h);
/// Variance of the sum of radiance x weight over the rays of a stratified hemisphere, as standard_error_of
/// finds it, were all light on the hits of the rays independent.
DVec3 strata_variance(const Hemisphere& h, std::span<const float> weight);
/// Standard error of irradiance_of, lx, from differences between neighbouring strata that cancel changes
/// which are even from cell to cell (conservative: on the mean its square exceeds the variance by the rest,
/// by a half to the double of the variance at an edge of light), less the part that even places on lamps take
/// away (Hemisphere::lamps). Light that no ray has found is not known of. Unstructured sets: 0.
Rgb standard_error_of(const Hemisphere& h);
/// Harmonic mean distance, cosine-weighted, misses counting as infinitely far (docs/methods.md#a7), m;
/// infinity if all miss, 0 if a ray starts on the surface that it hits.
float harmonic_distance_m(const Hemisphere& h);
/// Harmonic mean distance that the light comes from: each ray counts by its part of the irradiance
/// (luminance), misses as infinitely far (docs/methods.md#a7), m; infinity where there is no light.
float light_distance_m(const Hemisphere& h);
/// Least distance over rays more than 10 degrees above the horizon (Tabellion and Lamorlette 2004), m.
float least_distance_m(const Hemisphere& h);

}  // namespace phos::inline estimate
