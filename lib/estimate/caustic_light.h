// Caustic light at a point, from caustic photons about it.
#pragma once

#include <memory>
#include <vector>

#include "estimate/zone/tangent_surface.h"
#include "photon/caustic_map.h"
#include "photon/local_density.h"
#include "scene/material/bsdf.h"

namespace phos::inline estimate {

/// Estimates it where it is asked for: no record smears it. Const and usable from any thread, each with a
/// worker of its own; holds a reference to `rays`.
class CausticLight {
 public:
  /// An estimate counts `most_photons` at most: 1 / sqrt of that is the relative noise of even light.
  CausticLight(const RayScene& rays, std::shared_ptr<const CausticMap> map, std::size_t most_photons);

  struct Worker {
    CausticMap::Worker map;
    std::vector<CausticHit> hits;  ///< nearest first; those nearer than the estimate's radius count
    std::vector<float> distance2_m2;
    std::vector<Rgb> flux_lm;
  };

  /// Irradiance on the surface through p that faces n (unit): photons that landed about it, over the part of
  /// the disc that is surface in sight of p. Of fewer than the usual photons where `most_photons` says. An
  /// error of `enough_lx` is no matter: no more photons are looked for than it takes, and no border of the
  /// surface where all light is so little.
  LocalDensity on_surface(const Vec3& p, const Vec3& n, Worker& worker, float enough_lx = 0) const {
    return on_surface(p, n, most_photons_, worker, enough_lx);
  }
  LocalDensity on_surface(const Vec3& p, const Vec3& n, std::size_t most_photons, Worker& worker,
                          float enough_lx = 0) const;
  /// Irradiance on a plane in free space: photons that cross a virtual disc, over the part of the disc that
  /// no wall hides from p. Passes over all photons.
  LocalDensity in_space(const Vec3& p, const Vec3& n, Worker& worker) const;
  /// Irradiance at a sensor: on_surface() where a surface that stores photons lies at p and faces n, else
  /// in_space().
  LocalDensity at_sensor(const Vec3& p, const Vec3& n, Worker& worker) const;

  /// Light that the glossy lobes of `bsdf` send on to wo, cd/m2, from the photons of an estimate just made by
  /// `worker`; its relative noise is the noise of the estimate.
  static Rgb gloss(const LocalDensity& estimate, const Bsdf& bsdf, const Vec3& wo, const Worker& worker);

 private:
  LocalDensity density(float radius_m, const ShareOfDisc& share, Worker& worker) const;
  DiscShare seen_share(std::span<const float> reach_m, double radius_m) const;

  const RayScene& rays_;
  TangentSurface surface_;
  std::shared_ptr<const CausticMap> map_;
  std::size_t most_photons_;
  float most_m_;
};

/// Photons of an estimate: a picture's pixels are many, and noise of a few photons in a hundred is little
/// against the differences that the eye makes out; a sensor must be right.
inline constexpr std::size_t kPictureCaustics = 512, kSensorCaustics = 8192;
/// Where rays of gathering and gloss land, whose light is averaged over many places.
inline constexpr std::size_t kGatherCaustics = 64;

}  // namespace phos::inline estimate
