// Plots of the results of a study.
#pragma once

#include <string>
#include <vector>

#include "image/plot/plot.h"
#include "study/results/results.h"

namespace phos::inline study {

struct NamedPlot {
  std::string name;   ///< of its files, without extension
  std::string title;  ///< in words
  Plot plot;
};

/// For each scene and camera and each kind of result: error over time, memory and bytes of files, with the
/// intervals of error and the front; and for each factor of numbers, the effect of its values on error and
/// time. Plots of which no point can be shown (all errors 0, on a logarithmic axis) are left out.
std::vector<NamedPlot> plots_of(const StudyFile& study, const StudyWork& work, const StudyResults& results);

}  // namespace phos::inline study
