// Limits of views: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline view {

inline constexpr Limit kMostQuestionBytes{"bytes of a message that a page sends to `phos-view`", 32768,
                                          "`phos-view` closes the connection"};
inline constexpr Limit kMostConnections{"connections to `phos-view` at the same time", 64,
                                        "`phos-view` closes the newest connection"};

inline constexpr Limit kMostPointsAsked{
    "points of a message that a page sends to `phos-view`, and so `--records-per-frame`", 1000,
    "exit code 2; `phos-view` closes the connection"};
inline constexpr Limit kMostGrownRecords{"records that `phos-view` adds to a cache", 1 << 17,
                                         "`phos-view` adds no more, and the page says so"};

inline constexpr const Limit* kViewLimits[] = {&kMostQuestionBytes, &kMostConnections, &kMostPointsAsked,
                                               &kMostGrownRecords};

}  // namespace phos::inline view
