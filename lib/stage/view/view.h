// phos-view: scene, caches -> a walk through them in a browser.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "file/tool.h"
#include "scene/load.h"
#include "view/server.h"

namespace phos::stage {

/// Nothing is written that could depend on it.
inline constexpr int kViewAlgorithm = 1;

struct ViewCommand {
  std::string scene_path;            ///< or one of the caches: the two may change places
  std::vector<std::string> caches;   ///< of irradiance and radiance: FILE, or NAME=FILE (cache_sets.h)
  std::vector<std::string> compare;  ///< the same of a second set
  SceneOptions scene;
  ServerAddress address;
  std::optional<double> accuracy;  ///< of reading records
  std::int64_t lamp_places = 16;   ///< of an area lamp
  bool allow_mismatch = false;
};

/// The body of the program: serves until it is interrupted.
void run(Tool& tool, ViewCommand& asked);

}  // namespace phos::stage
