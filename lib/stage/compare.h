// phos-compare: image, reference -> error measures; or a sequence and another.
#pragma once

#include <string>

#include "file/tool.h"
#include "image/compare_limits.h"
#include "image/metrics.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kCompareAlgorithm = 1;

struct CompareCommand {
  std::string image, reference, second, frames, difference, per_frame;
  CompareOptions options;
  CompareLimits limits;
  bool json = false, flicker = false;
  double range = 0;  ///< that full colours of a difference picture stand for; 0: automatic
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set.
void run(Tool& tool, const CompareCommand& asked);

}  // namespace phos::stage
