// Two frames that follow one another, with everything that light is computed with.
#pragma once

#include <utility>

#include "estimate/gather.h"
#include "scene/lamp/luminaires.h"
#include "scene/motion/film.h"
#include "scene/rays.h"
#include "support/gathered.h"

namespace phos::test {

struct TwoFrames {
  TwoFrames(Scene first, Scene second)
      : scene{std::move(first), std::move(second)},
        rays{RayScene(scene[0]), RayScene(scene[1])},
        lights{Luminaires(scene[0]), Luminaires(scene[1])},
        change(changes(scene[0], scene[1])) {}
  TwoFrames(const TwoFrames&) = delete;

  Scene scene[2];
  RayScene rays[2];
  Luminaires lights[2];
  Changes change;
};

}  // namespace phos::test
