// Checks irradiance records that were read.
#pragma once

#include "record/irradiance_cache.h"

namespace phos::inline record {

/// In words that follow "has": "a value that is not finite"; nullptr: nothing.
const char* what_is_wrong(const IrradianceRecord& record);

}  // namespace phos::inline record
