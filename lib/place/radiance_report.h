// What phos-radiance tells of the records that it made.
#pragma once

#include <string>
#include <vector>

#include "core/json.h"
#include "place/radiance_placement.h"

namespace phos::inline place {

struct RadianceReport {
  Json figures;                    ///< an object, by name, for --stats
  std::vector<std::string> lines;  ///< for people
};
/// `cache` holds the records that the runs added, and perhaps earlier records.
RadianceReport report_of(const RadianceCache& cache, const std::vector<RadianceRun>& runs);

}  // namespace phos::inline place
