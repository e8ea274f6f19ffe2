#include "reference/map/caustic_part.h"

namespace phos::inline reference {

PhotonMap caustic_part(const PhotonMap& photons) {
  Photons caustic;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!is_caustic(static_cast<PhotonPath>(photons.path[i]))) continue;
    caustic.position.push_back(photons.position[i]), caustic.flux.push_back(photons.flux[i]);
    caustic.direction.push_back(photons.direction[i]), caustic.normal.push_back(photons.normal[i]);
    caustic.distance.push_back(photons.distance[i]);
    caustic.source_normal.push_back(photons.source_normal[i]);
    caustic.path.push_back(photons.path[i]), caustic.bounce.push_back(photons.bounce[i]);
  }
  return PhotonMap::build(std::move(caustic), photons.totals);
}

}  // namespace phos::inline reference
