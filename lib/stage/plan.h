// phos-plan: scene + error or seconds -> the pipeline that gives it, as a script; or carried out.
#pragma once

#include <string>

#include "file/tool.h"
#include "plan/options.h"
#include "scene/load.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kPlanAlgorithm = 4;

struct PlanCommand {
  std::string scene_path;
  SceneOptions scene;
  PlanOptions plan;
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set.
void run(Tool& tool, const PlanCommand& asked);

}  // namespace phos::stage
