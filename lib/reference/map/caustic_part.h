// The caustic photons of a map, with a tree of their own.
#pragma once

#include "photon/photon_map.h"

namespace phos::inline reference {

/// Photons of is_caustic() alone, without flights.
PhotonMap caustic_part(const PhotonMap& photons);

}  // namespace phos::inline reference
