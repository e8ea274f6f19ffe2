// The part of a surface about a place, and the photons that landed on it (FORMULAS C5).
#pragma once

#include <cstdint>
#include <vector>

#include "cache/estimator.h"
#include "cache/gradients.h"
#include "cache/record_options.h"
#include "photon/photon_map.h"
#include "scene/rays.h"

namespace phos {

/// The tangent plane at a place, and the slab about it that holds the photons of its zone.
struct ZonePlace {
  Vec3 p;
  Frame frame;
  float rounding_m;                // of coordinates here
  float above_m = 0, below_m = 0;  // of the slab
  bool parted = false;             // something stands between the place and a part of its surface
};

/// Does this photon count (direct light is computed apart)?
inline bool is_wanted(const PhotonMap& photons, std::uint32_t row, Quantity paths) {
  return paths == Quantity::all || photons.path[row] != static_cast<std::uint8_t>(PhotonPath::direct);
}

/// Half thickness of a zone of this radius, m.
float slab_m(const ZonePlace& place, float radius_m);
/// Cosine between normals from which two places count as one surface.
inline constexpr float kSameFacing = 0.9396926f;  // cos 20 deg (C5)
/// A photon that came from above has at least this: stored directions are rounded by as much
/// (encode_octahedral), and one that grazes the surface seems to come from below it.
inline constexpr float kLeastRise = -1e-4f;

/// Photons of a zone as they are gathered, and the memory for that.
struct GatheredPhotons {
  ZonePhotons zone;
  std::vector<float> height_m;  ///< of each over the tangent plane
  std::vector<std::uint32_t> rows, codes;
};

/// Rows of photons that a zone does not count.
struct LeftOut {
  std::uint32_t own = kNoPhoton;      ///< that the place sits on
  std::uint32_t decided = kNoPhoton;  ///< ZoneRadius::decided_by
};

/// Finds the photons of a zone. Const and usable from any thread.
class ZoneGatherer {
 public:
  ZoneGatherer(const PhotonMap& photons, const RayScene& rays, Quantity paths, float nearest_m)
      : photons_(photons), rays_(rays), paths_(paths), nearest_m_(nearest_m) {}

  /// Parallel sheets: the slab ends half way to the next surface above and below, if one is within it.
  void limit_slab(ZonePlace& place, float radius_m) const;

  /// Photons strictly within radius_m of the place on this surface, from this side, without `left_out`.
  void gather(const ZonePlace& place, float radius_m, const LeftOut& left_out,
              GatheredPhotons& gathered) const;

  /// Adds the photon that the place sits on, `share` of its flux. False: it came from below, and is not
  /// added.
  bool add_own(const ZonePlace& place, std::uint32_t row, float share, GatheredPhotons& gathered) const;

  /// Is there surface of this facing at an offset on the tangent plane, in sight of the place? Sets
  /// place.parted where there is, but out of sight.
  bool on_surface(ZonePlace& place, const Vec2& offset_m) const;

  /// Leaves out the photons that a wall parts from the place.
  void drop_hidden(const ZonePlace& place, GatheredPhotons& gathered) const;

 private:
  bool within_sight(const ZonePlace& place, const Vec2& offset_m, float height_m) const;

  const PhotonMap& photons_;
  const RayScene& rays_;
  Quantity paths_;
  float nearest_m_;  // photons from nearer count as from there
};

}  // namespace phos
