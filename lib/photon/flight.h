// A photon in flight, and the photons and sums that flights leave.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "photon/photon_map.h"
#include "scene/material/total_reflections.h"
#include "scene/mirror/planes.h"
#include "scene/rays.h"

namespace phos::inline photon {

/// Sums over paths.
struct PathSums {
  FluxSum emitted, stored, escaped, absorbed;
  std::uint64_t escaped_paths = 0, non_finite = 0, too_long = 0, kept_in_glass = 0;
};

/// What one chunk of paths gives.
struct PathPart {
  Photons photons;
  /// Of each photon and of each of its flights: its path's turn; empty where they lie in the order of paths.
  std::vector<std::uint32_t> turn, flight_turn;
  std::uint32_t turns = 0;
  PathSums sums;
  PathSums aimed;  ///< of aimed paths, whose light is in `sums` already: only stored photons count
  std::vector<Ray> rays;

  void restart() {
    sums = aimed = {};
    turn.clear(), flight_turn.clear(), rays.clear();
    turns = 0;
  }
  std::uint64_t too_long() const { return sums.too_long + aimed.too_long; }
};

/// A photon in flight.
struct Flight {
  Ray ray;
  Rgb flux_lm{0};
  FluxSum units;  // of flux_lm
  Vec3 source_normal{0, 0, 1};
  std::uint32_t bounce = 0;
  std::uint32_t events = 0;  // bounces and panes passed straight: numbers the random draws
  bool from_infinity = false;
  bool specular_only = true;  // since the light
  // Flat mirrors since a light that has images in them (MirrorPlanes).
  bool mirrored = false;
  std::int32_t chain = MirrorPlanes::kNone;
  bool in_glass = false;  // in solid glass
  TotalReflections total_reflections;
  Vec3 stretch_from{0};  // where the ray began, or the pane that it has passed last
  enum class Keep : std::uint8_t { all, others, caustics } keep = Keep::all;  // photons that are stored
  // Light that is not aimed at portals: light that is scattered through them goes by its children
  // (PortalSplit). A child is one up to the portal.
  enum class Astray : std::uint8_t { no, parent, child } astray = Astray::no;
  float portal_m = kInfinity;  // along the ray, of one astray
  std::uint64_t number = 0;    // of the path; of an aimed one, ~number
  std::uint32_t turn = 0;      // of the path among the paths of its part
  bool aimed_class = false;    // the first event was on a surface at which paths are aimed
  std::uint32_t aimed_at = 0;  // triangle

  /// Is the photon, or the stretch, this path's to tell of?
  bool tells() const {
    return keep == Keep::all || (keep == Keep::caustics) == (is_caustic(path()) && aimed_class);
  }

  PhotonPath path() const {
    if (bounce == 0) return PhotonPath::direct;
    if (!specular_only) return PhotonPath::indirect;
    return mirrored ? PhotonPath::mirrored : PhotonPath::caustic;
  }
};

/// Notes the stretch that caustic light has flown since the last surface, where no photon tells of it.
inline void note_flight(Flights& flights, const Flight& flight, float length_m) {
  if (!is_caustic(flight.path()) || flight.in_glass || !flight.tells()) return;
  flights.from.push_back(flight.stretch_from);
  flights.flux.push_back(flight.flux_lm);
  flights.direction.push_back(encode_octahedral(flight.ray.direction));
  flights.length.push_back(length_m);
}

inline void store(Photons& photons, const Flight& flight, const SurfacePoint& point) {
  photons.position.push_back(point.position);
  photons.flux.push_back(flight.flux_lm);
  photons.direction.push_back(encode_octahedral(-flight.ray.direction));
  photons.normal.push_back(encode_octahedral(point.smooth_normal));
  photons.distance.push_back(flight.from_infinity ? kInfinity : point.distance_m);
  photons.source_normal.push_back(encode_octahedral(flight.source_normal));
  photons.path.push_back(static_cast<std::uint8_t>(flight.path()));
  photons.bounce.push_back(static_cast<std::uint8_t>(std::min(flight.bounce, 255u)));
}

}  // namespace phos::inline photon
