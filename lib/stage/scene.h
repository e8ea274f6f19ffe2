// phos-scene: scene or photometry -> what it holds, what its light requires, and what is wrong with it.
#pragma once

#include <string>

#include "file/tool.h"
#include "radiance/gloss_tables.h"
#include "scene/load.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kSceneAlgorithm = 1;

struct SceneCommand {
  std::string path;
  SceneOptions scene;
  GlossBy gloss = GlossBy::automatic;
  bool json = false;
};

/// The body of the program: `asked` holds what the options of `tool` are declared to set.
void run(Tool& tool, const SceneCommand& asked);

}  // namespace phos::stage
