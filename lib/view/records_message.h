// Irradiance records as the page draws them.
#pragma once

#include <string>

#include "record/irradiance_cache.h"

namespace phos::inline view {

/// MessageKind::records, to be read at this accuracy. None of the records may have a footprint.
std::string records_message(const IrradianceCache& cache, double accuracy);

}  // namespace phos::inline view
