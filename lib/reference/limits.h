// Limits of the reference: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline reference {

/// RandomStream counts so many bounces. Reached with probability kMostSurvival^65534 at most.
inline constexpr Limit kMostEvents{"scatterings and panes of a path of `phos-reference`", 65534,
                                   "the path ends"};

inline constexpr const Limit* kReferenceLimits[] = {&kMostEvents};

}  // namespace phos::inline reference
