// Limits of direct light: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline direct {

inline constexpr Limit kMostShadowRays{
    "shadow rays from one point to one lamp that `phos-sense` sends for an error", 4096,
    "the stated error is above the error asked for"};

inline constexpr const Limit* kDirectLimits[] = {&kMostShadowRays};

}  // namespace phos::inline direct
