// phos-sense: scene, caches, points -> lux and its standard error at sensors.
#pragma once

#include <string>
#include <vector>

#include "file/tool.h"
#include "reference/method.h"
#include "reference/point_irradiance.h"
#include "scene/load.h"
#include "sense/grid.h"
#include "sense/sensors.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kSenseAlgorithm = 17;

struct SenseCommand {
  std::vector<std::string> inputs;  ///< scene and caches
  SceneOptions scene;
  std::string points, summary;  ///< files
  GridOptions grid;
  SensorOptions sense;
  PointOptions exactly;  ///< of --exact
  ReferenceMethod method = ReferenceMethod::automatic;
  std::string part;  ///< "k/n", or empty: all sensors
  std::string isa;
  bool exact = false, allow_mismatch = false, factors = false;
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set, and gets
/// the values that were left to it.
void run(Tool& tool, SenseCommand& asked);

}  // namespace phos::stage
