// Checks radiance records that were read.
#pragma once

#include "radiance/cache.h"

namespace phos::inline radiance {

/// In words that follow "has": "a value that is not finite"; nullptr: nothing.
const char* what_is_wrong(const RadianceRecord& record);

}  // namespace phos::inline radiance
