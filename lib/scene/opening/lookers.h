// Places on the surfaces of rooms that look for the sky.
#pragma once

#include <vector>

#include "scene/rays.h"

namespace phos::inline scene {

/// A place on a surface, lifted off it, with the unit normal of its side.
struct Looker {
  Vec3 position{0}, normal{0};
  std::vector<Vec3> sky{};  ///< directions in which it sees the sky
};

/// Places within: those that see the sky, but in less than a quarter of their half space, and places that one
/// of these sees and that see no more of the sky (the ceiling of a room, say, sees nothing of the sky through
/// a hole in it). The first are looked for all over the scene, half of them by area and half by triangles, so
/// that a large ground does not hide a house; further ones are places that these see, so that a room of which
/// one place is found is known whole. Empty where nothing is within. Glass is looked through. Same for any
/// number of threads.
std::vector<Looker> look_about(const RayScene& rays);

}  // namespace phos::inline scene
