// Which triplets a set of parts holds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/spectral/join_bands.h"

namespace phos::inline scene {

/// Index into parts.paths for each triplet, from 1, -1 for dark ones, after the checks of join_bands.h.
/// `triplet_of(i)` is that of part i.
std::vector<int> order_of(const BandParts& parts, const std::function<BandTriplet(std::size_t)>& triplet_of);

}  // namespace phos::inline scene
