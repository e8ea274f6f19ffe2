// Whether a plan shows gloss by radiance records.
#pragma once

#include <functional>

#include "plan/way/direct.h"

namespace phos::inline plan {

enum class PlanGloss { automatic, cached, traced };

/// Plans gloss by rays, by radiance records where harmonics hold it (Needs::held_gloss), or (automatic) both
/// ways, and keeps the records by kLeastGlossGain (plan/calibration.h). Records are tried for a picture
/// alone, whose direct light comes by shadow rays. A way that cannot reach the goal, and radiance records
/// whose pilot throws PilotTooLong, give place to the other way; throws as make_plan() where none can reach
/// it. Says in `needs` why. `direct` plans the direct light of a task.
PlannedWay plan_gloss(const PlanTask& task, const PlanGoal& goal, PlanGloss which,
                      const std::function<PlannedWay(const PlanTask&)>& direct, Needs& needs);

}  // namespace phos::inline plan
