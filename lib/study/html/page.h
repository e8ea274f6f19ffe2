// A study as one page that needs nothing else.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/results/plots.h"
#include "study/results/results.h"

namespace phos::inline study {

struct PageInput {
  const StudyFile& study;
  const StudyWork& work;
  const StudyResults& results;
  const std::vector<NamedPlot>& plots;
  std::size_t pictures = 24;  ///< points of each view that are shown, those on the front first
};

/// HTML with everything inside: plots as SVG, pictures as PNG (tone mapped with the exposure of the
/// reference; two at a time under a slider), differences in false colours of one range, a table that sorts by
/// any column, effects, and the command lines of each point. Reads the pictures of the first seed.
std::string study_page(const PageInput& input);

}  // namespace phos::inline study
