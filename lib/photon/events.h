// The numerical events that tracing counts.
#pragma once

#include "core/events.h"

namespace phos::inline photon {

inline const Event kEscapedEvent{"photon left the scene", "paths"};
inline const Event kKeptInGlassEvent{"photon that total reflection keeps in glass ended", "photons"};
inline const Event kNonFiniteEvent{"photon with non-finite flux", "photons", kRare,
                                   "check the powers of the lights and the materials"};
inline const Event kTooLongEvent{"photon path of 65535 bounces ended", "photons", kRare,
                                 "a material reflects all of its light: lower its reflectance"};

}  // namespace phos::inline photon
