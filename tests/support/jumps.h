// At which frames of a film something jumps.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/motion/film.h"

namespace phos::test {

/// The frames up to which light must not be interpolated: jumps() is true of the step to each of them.
inline std::vector<std::int64_t> jumps_of(const std::string& path, std::int64_t frames) {
  std::vector<Scene> scene;
  for (std::int64_t f = 0; f < frames; ++f) scene.push_back(load_frame(path, {}, f));
  std::vector<std::int64_t> found;
  for (std::size_t f = 1; f < scene.size(); ++f) {
    const Scene &before = scene[f > 1 ? f - 2 : f - 1], &after = scene[std::min(f + 1, scene.size() - 1)];
    if (jumps(before, scene[f - 1], scene[f], after)) found.push_back(static_cast<std::int64_t>(f));
  }
  return found;
}

}  // namespace phos::test
