// phos-merge: the shards of one run -> the file of the whole run.
#pragma once

#include <string>
#include <vector>

#include "file/tool.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kMergeAlgorithm = 1;

struct MergeCommand {
  std::vector<std::string> shards;  ///< or parts
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set.
void run(Tool& tool, const MergeCommand& asked);

}  // namespace phos::stage
