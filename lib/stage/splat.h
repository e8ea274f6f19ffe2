// phos-splat: scene + caches -> OpenEXR picture.
#pragma once

#include <string>
#include <vector>

#include "file/container.h"
#include "file/tool.h"
#include "image/image.h"
#include "scene/load.h"
#include "splat/gl/kinds.h"
#include "splat/picture/render.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kSplatAlgorithm = 20;

struct SplatCommand {
  std::string scene_path;           ///< or one of the caches: the two may change places
  std::vector<std::string> caches;  ///< of irradiance and radiance, and lobes
  SceneOptions scene;
  RenderOptions render;
  GlBy gl = GlBy::osmesa;
  ExrCompression compression = ExrCompression::zip;
  std::string misses, gloss_misses;  ///< files
  bool allow_mismatch = false;
  std::vector<Container> opened;  ///< the caches, from the first frame on
};

/// The body of the program, for each frame: `asked` holds the values that the options of `tool` are declared
/// to set, and gets the values that were left to it.
void run(Tool& tool, SplatCommand& asked);

}  // namespace phos::stage
