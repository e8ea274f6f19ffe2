// Where the way from rooms to the sky is narrowest.
#pragma once

#include <vector>

#include "scene/opening/lookers.h"

namespace phos::inline scene {

/// Leaves out few lookers that lie outermost on a side, where the others see the sky through far less of a
/// box about themselves alone: through a waist. Under eaves, say, some places are within, and portals about
/// them would stand before the wall, not in its windows; light from the ground there would come in by no
/// portal.
void draw_to_waists(std::vector<Looker>& lookers);

}  // namespace phos::inline scene
