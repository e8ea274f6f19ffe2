// The results of a study for programs.
#pragma once

#include "core/json.h"
#include "study/results/results.h"

namespace phos::inline study {

/// All results: the study, every run with its costs, points, effects, and the command lines of each point.
Json results_json(const StudyFile& study, const StudyWork& work, const StudyJournal& journal,
                  const StudyResults& results);

}  // namespace phos::inline study
