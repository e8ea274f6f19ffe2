// Caustic photons: light that came from a lamp by mirrors and glass alone, as it lands on surfaces and as it
// crosses space.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/vector.h"
#include "file/container.h"
#include "photon/kd_tree.h"
#include "photon/photon_map.h"

namespace phos {

/// Photons alone, as they travel in files of caches: columns of those that landed, and flights.
struct CausticPhotons {
  std::vector<Vec3> position;            ///< m
  std::vector<Rgb> flux;                 ///< lm
  std::vector<std::uint32_t> direction;  ///< octahedral, towards where it came from
  std::vector<std::uint32_t> normal;     ///< octahedral, smooth, of the side it landed on
  std::vector<float> distance;           ///< m, to the last surface that turned it
  Flights flights;
  Rgb photon_lm{0};  ///< that a path of the run starts with, mean: what one photon brings where there is none
  std::size_t size() const { return position.size(); }
  bool empty() const { return size() == 0 && flights.size() == 0; }
};

/// Those of a photon map, in its order.
CausticPhotons caustics_of(const PhotonMap& photons);

/// Tensors caustic_position, caustic_flux, caustic_direction, caustic_normal, caustic_distance and those of
/// flights (caustic_flight_from, ...), each absent where there are none of its kind.
void add_columns(ContainerWriter& writer, const CausticPhotons& photons);
/// Throws Error(bad_input) for damaged columns. photon_lm is not in columns.
CausticPhotons read_caustics(const Container& file);

/// One that counts for a disc.
struct CausticHit {
  float distance2_m2 = 0;  ///< from the middle of the disc
  Rgb flux_lm{0};          ///< per unit of the disc's area
  Vec3 position{0};        ///< m, where it lands or crosses
  Vec3 direction{0};       ///< unit, towards where it came from
};

/// Neighbour search over them. Const and usable from any thread.
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
  /// (FORMULAS-glass G7.1: each counts whole, without a cosine). Asks `open(crossing, end)` of those that end
  /// at a photon whether its last stretch begins before the crossing: is nothing, not even a pane, between
  /// the two points. Passes over all photons.
  template <class Open>
  void crossing(const Vec3& p, const Vec3& n, float radius_m, const Open& open,
                std::vector<CausticHit>& hits) const {
    hits.clear();
    each_crossing(p, n, radius_m, [&](const CausticHit& hit, const Vec3* end) {
      if (!end || open(hit.position, *end)) hits.push_back(hit);
    });
    sort(hits);
  }

  /// Cosine between normals from which two places count as one surface.
  static constexpr float kFacing = 0.9396926f;  // cos 20 deg

 private:
  template <class Visit>
  void each_crossing(const Vec3& p, const Vec3& n, float radius_m, const Visit& visit) const {
    const std::size_t landed = photons_.size();
    for (std::size_t i = 0; i < landed + photons_.flights.size(); ++i) {
      const bool ends = i < landed;
      const std::size_t f = i - landed;
      const Vec3& from = ends ? photons_.position[i] : photons_.flights.from[f];
      const Vec3& way = way_[i];
      // Light travels against `way` where it ends at a photon: its front is where it comes from.
      const float facing = ends ? glm::dot(way, n) : -glm::dot(way, n);
      if (!(facing > 0)) continue;
      const float to_plane = glm::dot(p - from, n) * (ends ? 1.f : -1.f);
      const float length = ends ? photons_.distance[i] : photons_.flights.length[f];
      if (!(to_plane >= 0) || !(to_plane <= length * facing)) continue;
      const Vec3 at = from + (to_plane / facing) * way;
      const Vec3 apart = at - p;
      const float distance2 = glm::dot(apart, apart);
      if (!(distance2 < radius_m * radius_m)) continue;
      visit(CausticHit{distance2, ends ? photons_.flux[i] : photons_.flights.flux[f], at, ends ? way : -way},
            ends ? &from : nullptr);
    }
  }
  static void sort(std::vector<CausticHit>& hits);

  CausticPhotons photons_;
  std::vector<Vec3> way_;  // decoded directions: of photons, then of flights
  KdTree tree_;
  Rgb one_photon_lm_{0};
};

}  // namespace phos
