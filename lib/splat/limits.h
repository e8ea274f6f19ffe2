// Limits of pictures from caches: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline splat {

inline constexpr Limit kMostNoiseRays{"rays of a pixel that `--noise` chooses", 4096,
                                      "the noise exceeds the noise asked for; a warning says so"};

inline constexpr const Limit* kSplatLimits[] = {&kMostNoiseRays};

}  // namespace phos::inline splat
