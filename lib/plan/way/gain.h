// Two ways of a plan, compared by their predictions.
#pragma once

#include <string>

#include "plan/plan.h"

namespace phos::inline plan {

/// Does `other` gain enough over the usual way? It has to take less than the part `least` of the usual
/// seconds; where the goal names no error: to leave less than that part of the usual error.
bool pays(const Prediction& other, const Prediction& usual, const PlanGoal& goal, double least);

/// "4.1 % in 12 s"
std::string figures(const Prediction& prediction);

}  // namespace phos::inline plan
