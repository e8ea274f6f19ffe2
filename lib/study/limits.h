// Limits of studies: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline study {

inline constexpr Limit kMostSettings{"settings of a study: all combinations of its values", 100000,
                                     "exit code 2"};
inline constexpr Limit kMostRepeats{"repeats of a study", 100000, "exit code 2"};

inline constexpr const Limit* kStudyLimits[] = {&kMostSettings, &kMostRepeats};

}  // namespace phos::inline study
