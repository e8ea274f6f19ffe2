// Limits of sensors: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline sense {

inline constexpr Limit kMostGridPoints{"sensors of a grid (`--grid`)", 100000000, "exit code 2"};

inline constexpr const Limit* kSenseLimits[] = {&kMostGridPoints};

}  // namespace phos::inline sense
