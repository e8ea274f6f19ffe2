// Photons put where a test wants them, each with a flux and a direction of its own.
#pragma once

#include <vector>

#include "photon/photon_map.h"

namespace phos::test {

struct Landed {
  Vec3 position{0};
  Vec3 direction{0, 1, 0};  ///< towards where it came from
  float flux_lm = 1;
  Vec3 normal{0, 1, 0};  ///< of the side that it landed on
};

inline PhotonMap map_of(const std::vector<Landed>& landed) {
  Photons photons;
  double flux = 0;
  for (const Landed& l : landed) {
    photons.position.push_back(l.position), photons.flux.push_back(Rgb(l.flux_lm));
    photons.direction.push_back(encode_octahedral(glm::normalize(l.direction)));
    photons.normal.push_back(encode_octahedral(l.normal));
    photons.distance.push_back(2);
    photons.source_normal.push_back(encode_octahedral(-glm::normalize(l.direction)));
    photons.path.push_back(static_cast<std::uint8_t>(PhotonPath::indirect)), photons.bounce.push_back(1);
    flux += static_cast<double>(l.flux_lm);
  }
  PhotonTotals totals;
  totals.emitted = totals.stored = landed.size();
  totals.emitted_flux_lm = totals.stored_flux_lm = Rgb(static_cast<float>(flux));
  return PhotonMap::build(std::move(photons), totals);
}

}  // namespace phos::test
