// How far a place's surroundings are, and how wide its zone should be (docs/methods.md#a7, #c6).
#pragma once

#include <cstdint>
#include <vector>

#include "estimate/zone/photon_zone.h"

namespace phos::inline estimate {

struct ZoneRadius {
  float radius_m;
  /// The row of the photon whose distance decided the radius, if it may lie within. All others are as dense
  /// there as everywhere; this one is there for certain, and must not be counted.
  std::uint32_t decided_by = kNoPhoton;
};

/// Const and usable from any thread.
class Surroundings {
 public:
  Surroundings(const PhotonMap& photons, const RayScene& rays, const RecordOptions& resolved,
               std::uint64_t seed)
      : photons_(photons), rays_(rays), options_(resolved), seed_(seed) {}

  /// Distance of the surroundings, m, by photons and rays; infinity if there are none. Photons know the lit
  /// ones, rays the dark ones too: the harmonic mean of both, in which photons weigh less the fewer of those
  /// looked for are near.
  float distance_m(const ZonePlace& place, std::uint64_t item, std::uint32_t left_out,
                   NearPhotons& near) const;

  /// The second query's radius: a x R, enlarged or reduced for the photons that `near`, of distance_m(),
  /// promises.
  ZoneRadius zone_radius(const ZonePlace& place, const NearPhotons& near, float distance_m) const;

 private:
  float by_rays_m(const ZonePlace& place, std::uint64_t item) const;
  float by_photons_m(const ZonePlace& place, std::uint32_t left_out, float limit_m, NearPhotons& near) const;

  const PhotonMap& photons_;
  const RayScene& rays_;
  RecordOptions options_;
  std::uint64_t seed_;
};

}  // namespace phos::inline estimate
