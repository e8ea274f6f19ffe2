// Settings that are usual for an error, where no pilot tells what a scene takes.
#pragma once

#include "study/plan.h"

namespace phos {

/// By rules that hold in the mean over scenes: noise goes with the root of rays and photons, and the bias of
/// records with their accuracy. `error` is relative, in
/// (0, 1]. With several `lamps` of an extent each gets fewer of a pixel's rays.
Knobs usual_knobs(const PlanTask& task, double error, std::size_t lamps);
/// A plan of them: nothing is predicted. `why` is its only warning. A goal of seconds alone is taken for
/// `usual_error`.
Plan usual_plan(const PlanTask& task, const PlanGoal& goal, double usual_error, std::size_t lamps,
                const std::string& why);

}  // namespace phos
