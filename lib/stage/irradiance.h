// phos-irradiance: scene, photons or caches -> irradiance records.
#pragma once

#include <string>
#include <vector>

#include "estimate/record_options.h"
#include "file/tool.h"
#include "place/placement_options.h"
#include "scene/load.h"
#include "splat/gl/kinds.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kIrradianceAlgorithm = 24;

struct IrradianceCommand {
  std::vector<std::string> inputs;
  SceneOptions scene;
  /// Of one time: radii may follow the light.
  RecordOptions records = [] {
    RecordOptions stills;
    stills.radius = RadiusRule::light;
    return stills;
  }();
  PlacementOptions placement;
  std::string at, add_to;  ///< files
  std::string isa;
  GlBy gl = GlBy::osmesa;
  bool allow_mismatch = false;
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set, and gets
/// the values that were left to it.
void run(Tool& tool, IrradianceCommand& asked);

}  // namespace phos::stage
