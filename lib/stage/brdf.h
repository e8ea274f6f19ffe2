// phos-brdf: scene -> glossy materials on hemispherical harmonics.
#pragma once

#include <string>

#include "file/tool.h"
#include "radiance/brdf/lamp_figure_options.h"
#include "radiance/brdf/table.h"
#include "scene/load.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kBrdfAlgorithm = 2;

struct BrdfCommand {
  std::string scene_path, bases;  ///< files
  SceneOptions scene;
  BrdfTableOptions brdf;
  LampFigureOptions figure;
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set.
void run(Tool& tool, const BrdfCommand& asked);

}  // namespace phos::stage
