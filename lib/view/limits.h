// Limits of views: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline view {

inline constexpr Limit kMostQuestionBytes{"bytes of a message that a page sends to `phos-view`", 4096,
                                          "`phos-view` closes the connection"};
inline constexpr Limit kMostConnections{"connections to `phos-view` at the same time", 64,
                                        "`phos-view` closes the newest connection"};
inline constexpr Limit kMostPageTexels{"pixels of all textures that `phos-view` sends to a page", 1 << 26,
                                       "`phos-view` halves the sides of the largest textures until they fit"};
inline constexpr Limit kMostPageBytes{"bytes of a scene that `phos-view` sends to a page", 1 << 30,
                                      "exit code 2"};

inline constexpr const Limit* kViewLimits[] = {&kMostQuestionBytes, &kMostConnections, &kMostPageTexels,
                                               &kMostPageBytes};

}  // namespace phos::inline view
