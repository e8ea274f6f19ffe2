// Limits of views: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline view {

inline constexpr Limit kMostQuestionBytes{"bytes of a message that a page sends to `phos-view`", 4096,
                                          "`phos-view` closes the connection"};
inline constexpr Limit kMostConnections{"connections to `phos-view` at the same time", 64,
                                        "`phos-view` closes the newest connection"};

inline constexpr const Limit* kViewLimits[] = {&kMostQuestionBytes, &kMostConnections};

}  // namespace phos::inline view
