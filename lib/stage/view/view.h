// phos-view: scene, caches -> a walk through them in a browser, served or as one page.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "file/tool.h"
#include "scene/load.h"
#include "stage/view/growth.h"
#include "view/server.h"

namespace phos::stage {

/// Of --static, and of the caches that grow. Nothing compares it for these: their records depend on the walk
/// too.
inline constexpr int kViewAlgorithm = 2;

struct ViewCommand {
  std::string scene_path;  ///< or one of the caches: the two may change places
  std::vector<std::string>
      caches;  ///< of irradiance and radiance: FILE, or NAME=FILE (cache_sets.h); photons
  std::vector<std::string> compare;  ///< the same of a second set
  SceneOptions scene;
  ServerAddress address;
  std::optional<double> accuracy;  ///< of reading records
  std::int64_t lamp_places = 16;   ///< of an area lamp
  GrowthCommand growth;
  std::string static_path;           ///< of a page that needs no server; "": a server
  std::int64_t texture_size = 1024;  ///< of static pages: texels of the longer side at most
  bool allow_mismatch = false;
};

/// The body of the program: serves until it is interrupted, or writes the static page.
void run(Tool& tool, ViewCommand& asked);

}  // namespace phos::stage
