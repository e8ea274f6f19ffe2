// The numerical events that drawing values counts.
#pragma once

#include "core/events.h"

namespace phos::inline image {

inline const Event kNonFinitePixelEvent{"non-finite pixel", "pixels"};
inline const Event kNotShownEvent{"point that cannot be shown", "points"};

}  // namespace phos::inline image
