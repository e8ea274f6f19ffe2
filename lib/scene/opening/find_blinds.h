// Blinds of a scene.
#pragma once

#include <vector>

#include "scene/opening/blind.h"
#include "scene/rays.h"

namespace phos::inline scene {

/// Rows of at least three parts of the scene, straight, alike and at least three times as long as they are
/// wide, each not farther from the next than three times its width, with the sky to be seen on one line in
/// sixteen out of their gaps. What lets light through straight is no slat. Their lengths may differ by a
/// hundredth. Blinds that are not found only cost noise. Same for any number of threads.
std::vector<Blind> find_blinds(const RayScene& rays);

}  // namespace phos::inline scene
