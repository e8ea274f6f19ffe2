// The part of a surface about a place, and the photons that landed on it (docs/methods.md#c5).
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "estimate/estimator.h"
#include "estimate/record_options.h"
#include "estimate/zone/facing_cells.h"
#include "estimate/zone/gradients.h"
#include "estimate/zone/tangent_surface.h"
#include "photon/photon_map.h"
#include "scene/rays.h"

namespace phos::inline estimate {

/// Photons that records count.
struct Counted {
  Quantity paths = Quantity::indirect;  ///< all: direct light counts, with light of images in flat mirrors
  bool caustics = true;                 ///< caustic light counts
  bool mirrored = true;                 ///< light of images in flat mirrors counts
  Counted(Quantity paths_counted) : paths(paths_counted) {}
  explicit Counted(const RecordOptions& options)
      : paths(options.paths), caustics(!options.caustics_apart), mirrored(!options.images_apart) {}
};
inline bool is_wanted(const PhotonMap& photons, std::uint32_t row, const Counted& counted) {
  const auto path = static_cast<PhotonPath>(photons.path[row]);
  const bool all = counted.paths == Quantity::all;
  return (all || path != PhotonPath::direct) && (all || counted.mirrored || path != PhotonPath::mirrored) &&
         (counted.caustics || !is_caustic(path));
}

/// A photon that came from above has at least this: stored directions are rounded by as much
/// (encode_octahedral), and one that grazes the surface seems to come from below it.
inline constexpr float kLeastRise = -1e-4f;

/// Photons of a zone as they are gathered, and the memory for that.
struct GatheredPhotons {
  ZonePhotons zone;
  std::vector<float> height_m;        ///< of each over the tangent plane
  std::vector<std::uint32_t> family;  ///< of each (Photons::family); empty where the map has none
  std::vector<std::uint32_t> rows, codes;
};

/// The nearest photons of a place, and the memory to find them.
struct NearPhotons {
  std::vector<float> radii;        ///< m from the place, sorted
  std::uint32_t last = kNoPhoton;  ///< row of the last of them
  std::vector<Vec3> directions;
  std::vector<float> weights, distances;
  std::vector<std::uint32_t> rows;  ///< of all photons looked at, nearest first
  std::vector<float> distance2;     ///< of these, m2
  float complete_m = 0;             ///< they are all that lie nearer than this
  void clear() {
    radii.clear(), directions.clear(), weights.clear(), distances.clear();
    last = kNoPhoton;
  }
};

/// Rows of photons that a zone does not count.
struct LeftOut {
  std::uint32_t own = kNoPhoton;      ///< that the place sits on
  std::uint32_t decided = kNoPhoton;  ///< ZoneRadius::decided_by
};

/// Finds the photons of a zone. Const and usable from any thread.
class ZoneGatherer : public TangentSurface {
 public:
  ZoneGatherer(const PhotonMap& photons, const RayScene& rays, Counted counted, float nearest_m)
      : TangentSurface(rays), photons_(photons), counted_(counted), nearest_m_(nearest_m) {}

  /// Photons strictly within radius_m of the place on this surface, from this side, without `left_out`.
  /// `near`, of the same place, spares the search where it holds them all.
  void gather(const ZonePlace& place, float radius_m, const LeftOut& left_out, const NearPhotons& near,
              GatheredPhotons& gathered) const;

  /// Adds the photon that the place sits on, `share` of its flux. False: it came from below, and is not
  /// added.
  bool add_own(const ZonePlace& place, std::uint32_t row, float share, GatheredPhotons& gathered) const;

  /// Leaves out the photons that a wall parts from the place.
  void drop_hidden(const ZonePlace& place, GatheredPhotons& gathered) const;

 private:
  const FacingCells& facing() const;

  const PhotonMap& photons_;
  Counted counted_;
  float nearest_m_;  // photons from nearer count as from there
  mutable std::once_flag once_;
  mutable std::optional<FacingCells> facing_;  // when it is first needed
};

}  // namespace phos::inline estimate
