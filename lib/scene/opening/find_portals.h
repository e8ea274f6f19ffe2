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

}  // namespace phos::inline scene
