// Limits of direct light: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline direct {

inline constexpr Limit kMostShadowRays{"shadow rays from one point to one lamp by `phos-sense --error`", 4096,
                                       "the stated error exceeds the error asked for"};

inline constexpr const Limit* kDirectLimits[] = {&kMostShadowRays};

}  // namespace phos::inline direct
