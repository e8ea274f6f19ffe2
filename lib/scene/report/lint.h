// What is likely wrong with a scene, and how to mend it.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace phos::inline scene {

struct Finding {
  enum class Level { info, warning, error };
  Level level = Level::info;
  std::string code;     ///< stable, for scripts: "no-light"
  std::string message;  ///< the finding, with figures
  std::string mend;     ///< the remedy
};
const char* level_name(Finding::Level level);

/// Findings of a finalized scene, gravest first. The heuristics and their limits:
///   size: a diagonal above 300 m or below 1 cm is asked about (another unit than metres?);
///   light: total lumens over total surface below 1 lx (watts taken for lumens make everything 179 times
///   darker; a lit
///     room has 10 to 10,000 lx) or above 200,000 lx (noon sun is 100,000 lx);
///   reflectance: above 0.95 is asked about, above 1 is wrong;
///   sky: no camera gets light of it;
///   cameras: they stand inside of solids, or of glass;
///   normals: more than 1 % of triangles whose vertex normals point to their back.
std::vector<Finding> lint_scene(const Scene& scene);

}  // namespace phos::inline scene
