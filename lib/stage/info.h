// phos-info: the contents of a phos file, and how it was made.
#pragma once

#include <string>
#include <vector>

#include "file/inspect/rows.h"
#include "file/tool.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kInfoAlgorithm = 1;

struct InfoCommand {
  std::string path, output;
  std::vector<std::string> dump;
  bool json = false, canonical = false, points = false, verify = false, decode = false;
  PlyFormat ply = PlyFormat::ascii;
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set.
void run(Tool& tool, const InfoCommand& asked);

}  // namespace phos::stage
