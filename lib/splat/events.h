// The numerical events that pictures count.
#pragma once

#include "core/events.h"

namespace phos::inline splat {

inline const Event kDarkerThanBlackEvent{"harmonic light below zero", "samples"};

}  // namespace phos::inline splat
