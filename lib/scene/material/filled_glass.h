// Blocks of solid glass with something in them.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace phos::inline scene {

/// Of each triangle: is it of a block of solid glass, as thick as it is wide or nearly so, that holds other
/// surfaces? Light is not taken to pass straight through such a block by its parallel faces, as it does
/// through a plate: bent at the first face, it meets other parts of the objects within than a straight line
/// would. Parts hang together by the places of their corners; objects within are known by bounds of
/// instances. Hollow glass, which holds another surface of its own material, is walls, not a block. Empty:
/// there is none.
std::vector<std::uint8_t> find_filled_glass(const Scene& scene);

}  // namespace phos::inline scene
