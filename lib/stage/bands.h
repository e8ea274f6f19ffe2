// phos-bands: the results of all triplets of bands -> one picture or one table.
#pragma once

#include <string>
#include <vector>

#include "file/tool.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kBandsAlgorithm = 1;

struct BandsCommand {
  std::vector<std::string> parts;  ///< files
  std::vector<std::string> dark;   ///< numbers of triplets
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set.
void run(Tool& tool, const BandsCommand& asked);

}  // namespace phos::stage
