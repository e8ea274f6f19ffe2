// phos-radiance: scene, photons or caches, lobes -> radiance records.
#pragma once

#include <string>
#include <vector>

#include "file/tool.h"
#include "place/placement_options.h"
#include "place/radiance_placement.h"
#include "radiance/gloss_tables.h"
#include "scene/load.h"
#include "splat/gl/kinds.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kRadianceAlgorithm = 22;

struct RadianceCommand {
  std::vector<std::string> inputs;
  SceneOptions scene;
  RadianceOptions radiance;
  PlacementOptions placement;
  GlossBy gloss = GlossBy::automatic;
  GlBy gl = GlBy::osmesa;
  Store store = Store::compact;
  std::string at, add_to;  ///< files
  std::string isa;
  bool allow_mismatch = false;
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set, and gets
/// the values that were left to it.
void run(Tool& tool, RadianceCommand& asked);

}  // namespace phos::stage
