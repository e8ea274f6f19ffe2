// Settings that are usual for an error, where no pilot measures the scene.
#pragma once

#include "plan/options.h"

namespace phos::inline plan {

/// By rules of thumb, not measured on the scene: rays and photons grow as the error shrinks, and records
/// reach less far. `error` is relative, in (0, 1]. With several `lamps` of an extent each gets fewer of a
/// pixel's rays.
Knobs usual_knobs(const PlanTask& task, double error, std::size_t lamps);
/// A plan with usual_knobs(); it predicts nothing. `why` is its only warning. A goal without an error stands
/// for `usual_error`. Throws Error(usage) for an error below 0.37 %: its usual settings have more photons
/// than plans may have.
Plan usual_plan(const PlanTask& task, const PlanGoal& goal, double usual_error, std::size_t lamps,
                const std::string& why);

/// The plan of plan_footprint(), plan_gloss() and plan_direct(). Where plan.pilot_s is 0, or the pilot throws
/// PilotTooLong: usual_plan().
PlannedWay plan_or_usual(const PlanTask& task, const PlanGoal& goal, const PlanOptions& plan,
                         const LampCount& lamps, const std::function<Pilot(const PlanTask&)>& pilot,
                         Needs& needs);

}  // namespace phos::inline plan
