// Whether a plan puts light straight from the lamps into the records.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "plan/plan.h"
#include "scene/scene.h"

namespace phos::inline plan {

/// Lamps to each of which a picture sends shadow rays of its own: area lights and the environment.
struct LampCount {
  std::size_t lamps = 0;
  std::size_t facets = 0;  ///< of all area lights
};
LampCount count_lamps(const Scene& scene);

enum class PlanDirect { automatic, cached, traced };

/// A plan with the pilot that it rests on.
struct PlannedWay {
  PlanTask task;
  Pilot pilot;
  Plan plan;
};
/// Plans light straight from the lamps by shadow rays, in the records, or (automatic, for a picture alone of
/// many lamps) both ways, and keeps the records by kLeastGain (plan/calibration.h). A way that cannot reach
/// the goal gives place to the other; throws as make_plan() where none can. Says in `needs` why. `pilot` runs
/// the pilot of a task.
PlannedWay plan_direct(const PlanTask& task, const PlanGoal& goal, PlanDirect which, const LampCount& lamps,
                       const std::function<Pilot(const PlanTask&)>& pilot, Needs& needs);

}  // namespace phos::inline plan
