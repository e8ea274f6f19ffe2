// phos-scene: scene or photometry -> its contents, the stages that its light requires, and its faults.
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

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set.
void run(Tool& tool, const SceneCommand& asked);

}  // namespace phos::stage
