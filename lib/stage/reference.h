// phos-reference: scene -> converged OpenEXR picture, or lux at points, by path tracing or from a photon map.
#pragma once

#include <string>
#include <vector>

#include "file/tool.h"
#include "reference/render_options.h"
#include "scene/load.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kReferenceAlgorithm = 8;

struct ReferenceCommand {
  std::vector<std::string> inputs;  ///< scene, and photons of it for the methods that read them
  std::string points;               ///< file
  SceneOptions scene;
  ReferenceOptions reference;
  bool allow_mismatch = false;
};

/// The body of the program, for each frame: `asked` holds the values that the options of `tool` are declared
/// to set, and gets the values that were left to it.
void run(Tool& tool, ReferenceCommand& asked);

}  // namespace phos::stage
