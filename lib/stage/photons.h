// phos-photons: scene -> the map of where photons land.
#pragma once

#include <string>

#include "file/tool.h"
#include "photon/trace.h"
#include "scene/load.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kPhotonsAlgorithm = 8;

struct PhotonsCommand {
  std::string scene_path;
  SceneOptions scene;
  PhotonOptions photons;
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set.
void run(Tool& tool, const PhotonsCommand& asked);

}  // namespace phos::stage
