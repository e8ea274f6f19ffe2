// Can a radiance record be one? For what reads them.
#pragma once

#include "radiance/cache.h"

namespace phos::inline radiance {

/// In words that follow "has": "a value that is not finite"; nullptr: nothing.
const char* what_is_wrong(const RadianceRecord& record);

}  // namespace phos::inline radiance
