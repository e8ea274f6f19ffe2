// The results of a study as a table.
#pragma once

#include <string>

#include "study/results/results.h"

namespace phos::inline study {

/// A row for each setting. Absent values are empty cells.
std::string results_csv(const StudyFile& study, const StudyWork& work, const StudyResults& results);

}  // namespace phos::inline study
