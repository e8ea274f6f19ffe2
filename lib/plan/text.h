// A plan as a shell script, and as JSON.
#pragma once

#include <string>

#include "plan/plan.h"

namespace phos::inline plan {

/// What is asked, in a line: "image of 200 x 150 from camera desk, error at most 5 %".
std::string goal_line(const PlanTask& task, const PlanGoal& goal);
/// What was predicted: "error 4.1 % (3.5 % to 4.9 %) in 12 s (9.5 s to 15 s)".
std::string prediction_line(const Prediction& prediction);

/// A bash script that makes the plan's files in the folder of its first argument; its comments hold the
/// prediction and the reasons, and its `measured` error, if there is one. The scene's path is as it was
/// given.
std::string plan_script(const PlanTask& task, const Needs& needs, const Pilot& pilot, const PlanGoal& goal,
                        const Plan& plan, std::uint64_t seed, const std::string& measured = "");

/// What is meant by error, for --help and for scripts.
extern const char* const kErrorMeaning;

}  // namespace phos::inline plan
