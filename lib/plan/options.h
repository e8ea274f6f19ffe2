// What phos-plan is asked, from its command line.
#pragma once

#include <string>

#include "core/options.h"
#include "plan/estimate.h"
#include "plan/way/footprint.h"
#include "plan/way/gloss.h"
#include "scene/load.h"
#include "sense/grid.h"

namespace phos::inline plan {

struct PlanOptions {
  std::string error;  ///< "5%" or "0.05"
  double seconds = 0;
  enum class Of { image, lux, both } quantity = Of::image;
  std::string camera, points, output;
  std::string frames;  ///< "0:47"; "": one picture
  GridOptions grid;
  std::int64_t width = 0, height = 0;
  PlanDirect direct = PlanDirect::automatic;
  PlanGloss gloss = PlanGloss::automatic;
  PlanRecords records = PlanRecords::automatic;
  PlanFootprint footprint = PlanFootprint::automatic;
  double pilot_s = 10, reference_s = 0;
  std::int64_t rounds = 5;
  bool script = false, json = false, run = false;
  double usual_error = 0.05;  ///< that the pilot looks for where seconds are asked for
};
void declare_options(Options& options, PlanOptions& plan);

/// 0.05 of "5%", "5 %" and "0.05". Throws Error(usage) for a text that is no such number, or not between 0
/// and 100
/// %.
double read_error(const std::string& word);

/// Throw Error(usage) for an impossible goal, and for options that do not go together.
PlanGoal goal_of(const Options& options, const PlanOptions& plan);
/// Without the size of the picture, which is the scene's to say.
PlanTask task_of(const Options& options, const PlanOptions& plan, const std::string& scene,
                 const SceneOptions& scene_options);

/// Has every stage look for openings (--portals auto) where sky, sun or map shine into rooms and no portals
/// are given; says so in `needs`.
void add_portals(PlanTask& task, const Scene& scene, Needs& needs);

}  // namespace phos::inline plan
