// Caustic photons: light that came from a lamp by mirrors and glass alone, as it lands on surfaces and as it
// crosses space.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/vector.h"
#include "file/kinds/tensor_io.h"
#include "photon/photon_map.h"
#include "photon/tree/kd_tree.h"

namespace phos::inline photon {

/// Photons alone, as they travel in files of caches: columns of those that landed, and flights.
struct CausticPhotons {
  std::vector<Vec3> position;            ///< m
  std::vector<Rgb> flux;                 ///< lm
  std::vector<std::uint32_t> direction;  ///< octahedral, towards where it came from
  std::vector<std::uint32_t> normal;     ///< octahedral, smooth, of the side it landed on
  std::vector<float> distance;           ///< m, to the last surface that turned it
  Flights flights;
  Rgb photon_lm{0};  ///< mean flux at the start of a path of the run: of one photon where there is none
  std::size_t size() const { return position.size(); }
  bool empty() const { return size() == 0 && flights.size() == 0; }
};

/// The caustic photons of a photon map, in its order.
CausticPhotons caustics_of(const PhotonMap& photons);

/// Writes the tensors caustic_position, caustic_flux, caustic_direction, caustic_normal and caustic_distance
/// where there are photons, and caustic_flight_from and so on where there are flights.
void add_columns(TensorWriter& writer, const CausticPhotons& photons);
/// Throws Error(bad_input) for damaged columns. photon_lm is not in columns.
CausticPhotons read_caustics(const Container& file);

/// A photon or flight that counts for a disc.
struct CausticHit {
  float distance2_m2 = 0;  ///< from the middle of the disc
  Rgb flux_lm{0};          ///< per unit of the disc's area
  Vec3 position{0};        ///< m, where it lands or crosses
  Vec3 direction{0};       ///< unit, towards where it came from
  /// Row of the photon in which a crossing stretch ends; the stretch is as long as the way since the last
  /// event, and panes may have been passed on it: it is the photon's only if nothing is between the two.
  /// kFlight: it ends in none.
  std::uint32_t photon = kFlight;
  static constexpr std::uint32_t kFlight = ~0u;
};

/// Neighbour search over caustic photons. Const and usable from any thread.
class CausticMap {
 public:
  explicit CausticMap(CausticPhotons photons);
  const CausticPhotons& photons() const { return photons_; }
  /// What one photon carries: mean of all, lm; CausticPhotons::photon_lm where there are none.
  const Rgb& one_photon_lm() const { return one_photon_lm_; }

  /// Memory of one thread.
  struct Worker {
    std::vector<std::uint32_t> rows;
    std::vector<float> distance2_m2;
  };
  /// Photons on the surface through p that faces n, nearest first: of the k nearest of all, those that landed
  /// on this side, with normals within kFacing, in a slab of `above_m` and `below_m` about the tangent plane,
  /// strictly nearer than `radius_m`, which becomes the distance of the k-th where that is less. Distances
  /// are along the tangent plane.
  void landed(const Vec3& p, const Vec3& n, std::size_t k, float above_m, float below_m, float& radius_m,
              Worker& worker, std::vector<CausticHit>& hits) const;
  /// Stretches that cross the disc of `radius_m` about p from its front, the side n faces, nearest first
  /// (docs/methods.md#g7-1: each counts whole, without a cosine). Of more than `most` the nearest, and
  /// `radius_m` becomes the distance of the next. Passes over all photons.
  void crossing(const Vec3& p, const Vec3& n, std::size_t most, float& radius_m,
                std::vector<CausticHit>& hits) const;

  /// Cosine between normals from which two places count as one surface.
  static constexpr float kFacing = 0.9396926f;  // cos 20 deg

 private:
  CausticPhotons photons_;
  std::vector<Vec3> way_;  // decoded directions: of photons, then of flights
  KdTree tree_;
  Rgb one_photon_lm_{0};
};

}  // namespace phos::inline photon
