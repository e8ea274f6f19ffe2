// The numerical events that placing records counts.
#pragma once

#include "core/events.h"

namespace phos::inline place {

inline const Event kUncoveredEvent{"candidates left uncovered", "candidates"};
inline const Event kClampedEvent{"radii clamped to a neighbour", "records"};
inline const Event kRaisedEvent{"radii raised to the smallest", "records"};
inline const Event kSidesInsideEvent{"sides inside solids passed over", "sides"};

}  // namespace phos::inline place
