// phos-merge: the shards of one run -> the file of the whole run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "file/tool.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kMergeAlgorithm = 1;

/// Least value of --memory: the program itself, and buffers for as many photons as a map can hold.
inline constexpr std::uint64_t kLeastMergeMemory = std::uint64_t{64} << 20;

struct MergeCommand {
  std::vector<std::string> shards;  ///< or parts
  std::string memory;               ///< "2G"; empty: as much as it takes
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set.
void run(Tool& tool, const MergeCommand& asked);

}  // namespace phos::stage
