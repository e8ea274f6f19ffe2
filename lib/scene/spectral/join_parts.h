// What the runs of all triplets gave: the parts of a joined result.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace phos::inline scene {

/// The parts of one N, and its dark triplets: no lamp shines in them, so that there is no
/// part.
struct BandParts {
  std::vector<std::string> paths;
  std::vector<int> dark;
};

/// Index into parts.paths for each triplet, from 1, -1 for dark ones, after checks: throws Error(bad_input)
/// or Error(mismatch) as join_pictures() and join_readings() say.
/// `triplet_of(i)` is the triplet of part i.
std::vector<int> order_of(const BandParts& parts, const std::function<BandTriplet(std::size_t)>& triplet_of);

}  // namespace phos::inline scene
