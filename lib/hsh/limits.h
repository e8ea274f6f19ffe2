// Limits of hemispherical harmonics: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline hsh {

inline constexpr Limit kMostOrder{"order of radiance records, of lobes and of `--environment-mode hsh`", 30,
                                  "exit code 2"};

inline constexpr const Limit* kHshLimits[] = {&kMostOrder};

}  // namespace phos::inline hsh
