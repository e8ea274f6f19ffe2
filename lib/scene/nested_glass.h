// Solid glass within solid glass.
#pragma once

#include <optional>
#include <string>

#include "scene/rays.h"

namespace phos::inline scene {

/// A line for people where a part of solid glass (triangles that hang together) lies in other solid glass:
/// the index of a material is its own over that of air, so that the inner faces bend light as they do in air.
/// A hollow, whose fronts face into it, is no such part. Half of a part's triangles and more are in glass
/// then.
std::optional<std::string> nested_glass(const RayScene& rays);

}  // namespace phos::inline scene
