// Openings found from within, by the box about all places there.
#pragma once

#include <vector>

#include "scene/opening/portal.h"
#include "scene/rays.h"

namespace phos::inline scene {

/// Where the sky is seen from within (look_about()). The six faces of the box about all places within, but
/// for few before a waist (under eaves), are searched for openings (Openings), coarsely, and each that is
/// found once more in finer cells. An opening is found whole if any part is found; an opening that nobody
/// finds is left out: nothing may be aimed at portals alone. Empty where nothing is within. Glass is seen
/// through. Same for any number of threads.
std::vector<Portal> portals_about_rooms(const RayScene& rays);

}  // namespace phos::inline scene
