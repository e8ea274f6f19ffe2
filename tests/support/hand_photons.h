// Photon maps made by hand.
#pragma once

#include <vector>

#include "photon/photon_map.h"

namespace phos::test {

/// One indirect photon of 1 lm at each place of a floor that faces +y, from `direction` (towards where it
/// came from).
inline PhotonMap photons_on_floor(const std::vector<Vec3>& places, const Vec3& direction = {0, 1, 0},
                                  float distance_m = 2) {
  Photons photons;
  for (const Vec3& p : places) {
    photons.position.push_back(p), photons.flux.push_back(Rgb(1));
    photons.direction.push_back(encode_octahedral(glm::normalize(direction)));
    photons.normal.push_back(encode_octahedral({0, 1, 0}));
    photons.distance.push_back(distance_m), photons.source_normal.push_back(encode_octahedral({0, -1, 0}));
    photons.path.push_back(static_cast<std::uint8_t>(PhotonPath::indirect)), photons.bounce.push_back(1);
  }
  PhotonTotals totals;
  totals.emitted = totals.stored = places.size();
  totals.emitted_flux_lm = totals.stored_flux_lm = Rgb(static_cast<float>(places.size()));
  return PhotonMap::build(std::move(photons), totals);
}

}  // namespace phos::test
