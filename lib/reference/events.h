// The numerical events that path tracing counts, and programs that trace paths at points.
#pragma once

#include "core/events.h"

namespace phos::inline reference {

inline const Event kNonFiniteSampleEvent{"non-finite sample", "samples", kRare,
                                         "look for extreme values in materials and lights with phos-scene"};

}  // namespace phos::inline reference
