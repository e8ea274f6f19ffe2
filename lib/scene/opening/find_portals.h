// Openings of a scene: found, or named.
#pragma once

#include <string>
#include <vector>

#include "scene/opening/portal.h"
#include "scene/rays.h"

namespace phos::inline scene {

/// "auto": portals_about_rooms(). Otherwise named_portals(), each inwards on the side from which less of the
/// sky is seen.
std::vector<Portal> find_portals(const RayScene& rays, const std::string& which);

/// The scene's surfaces of the nodes and materials of these names (split_known_names()), both ways; none
/// without area. Throws Error(usage) for a name that there is not.
std::vector<Portal> named_portals(const Scene& scene, const std::string& names);

/// Where the sky is seen from within (look_about()). The six faces of the box about all places within, but
/// for few before a waist (under eaves), are searched for openings (Openings), coarsely, and each that is
/// found once more in finer cells. An opening is found whole if any part of it is; one that nobody finds is
/// left out: nothing may be aimed at portals alone. Empty where nothing is within. Glass is seen through.
/// Same for any number of threads.
std::vector<Portal> portals_about_rooms(const RayScene& rays);

}  // namespace phos::inline scene
