// The numerical events that films count.
#pragma once

#include "core/events.h"

namespace phos::inline temporal {

inline const Event kLostPlaceEvent{"place without a surface", "places"};
inline const Event kLostRecordEvent{"record without a surface", "records"};
inline const Event kTracedAheadEvent{"records traced one frame ahead", "records"};

}  // namespace phos::inline temporal
