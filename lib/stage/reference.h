// phos-reference: scene -> converged OpenEXR picture, or lux at points, by path tracing.
#pragma once

#include <string>

#include "file/tool.h"
#include "reference/render_options.h"
#include "scene/load.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kReferenceAlgorithm = 7;

struct ReferenceCommand {
  std::string scene_path, points;  ///< files
  SceneOptions scene;
  ReferenceOptions reference;
};

/// The body of the program, for each frame: `asked` holds the values that the options of `tool` are declared
/// to set, and gets the values that were left to it.
void run(Tool& tool, ReferenceCommand& asked);

}  // namespace phos::stage
