// A plan for programs: JSON.
#pragma once

#include <cstdint>

#include "core/json.h"
#include "plan/plan.h"

namespace phos::inline plan {

/// A plan for programs: goal, requirements, settings, predictions, models, commands ("{scene}" and
/// "{folder}" stand for paths).
Json plan_json(const PlanTask& task, const Needs& needs, const Pilot& pilot, const PlanGoal& goal,
               const Plan& plan, std::uint64_t seed);

}  // namespace phos::inline plan
