// Every combination of the values that a study varies.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/spec/study_file.h"

namespace phos::inline study {

/// A point of a study: one scene, one camera, one value of each factor.
struct Setting {
  std::size_t scene = 0, camera = 0;
  std::vector<std::size_t> level;  ///< of each factor
};

/// All of them: scenes change slowest, the last factor fastest. Throws Error(usage) for more than 100,000.
std::vector<Setting> expand_settings(const StudyFile& study);

/// "photons 100000, accuracy 0.1": the factors' values; "as given" where nothing varies.
std::string describe(const StudyFile& study, const Setting& setting);

}  // namespace phos::inline study
