// Irradiance records as the page draws them.
#pragma once

#include <span>
#include <string>

#include "record/irradiance_cache.h"
#include "view/message/writer.h"

namespace phos::inline view {

/// The fields of table "record" that a record sets, for records that serve something.
void add_records(std::span<const IrradianceRecord> records, MessageWriter& message);

/// MessageKind::records, to be read at this accuracy. None of the records may have a footprint.
std::string records_message(const IrradianceCache& cache, double accuracy);

}  // namespace phos::inline view
