// Whether the records of a plan have adaptive zones.
#pragma once

#include <functional>

#include "plan/way/direct.h"

namespace phos::inline plan {

enum class PlanFootprint { automatic, circle, adaptive };

/// Are adaptive zones asked for, where no pilot compares them with circular zones, and can they be had? Says
/// in `needs` why.
bool adaptive_untried(const PlanTask& task, PlanFootprint which, Needs& needs);

/// Plans the records of a picture with circular zones, with adaptive zones (docs/methods.md#e), or
/// (automatic) both ways, and keeps adaptive zones by kLeastFootprintGain (plan/calibration.h). `ways` plans
/// gloss and direct light of a task; `pilot` runs the pilot of a task. Adaptive zones need gathered rays, and
/// are not for sensors, which have a record each. Records that hold direct light have adaptive zones in any
/// case. The second pilot is left out where records that cost nothing and have no error would not pay either.
/// A way that cannot reach the goal, and adaptive zones whose pilot throws PilotTooLong, give place to the
/// other way; throws as make_plan() where none can reach it. Says in `needs` why.
PlannedWay plan_footprint(const PlanTask& task, const PlanGoal& goal, PlanFootprint which,
                          const std::function<PlannedWay(const PlanTask&, Needs&)>& ways,
                          const std::function<Pilot(const PlanTask&)>& pilot, Needs& needs);

}  // namespace phos::inline plan
