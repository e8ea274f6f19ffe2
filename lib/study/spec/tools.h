// What the programs of phos take, as they say themselves (--options-json).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/json.h"
#include "core/options.h"
#include "study/command.h"

namespace phos::inline study {

struct ToolOption {
  std::string name, kind, unit;  ///< kind: flag, number, integer, text, list, file, choice
  std::vector<std::string> choices;
  Range range;
  Json by_default;
};

/// The options of one program by their names, inputs left out.
struct ToolOptions {
  std::string tool;
  std::map<std::string, ToolOption> options;
  const ToolOption* find(const std::string& name) const;
};
/// Asks the program. Throws Error(bad_input) where it is not there or says nothing.
ToolOptions options_of(const CommandRunner& runner, const std::string& tool);

/// The words that give an option a value on a command line: {"--rays", "64"}, {"--direct-only"}, and none for
/// a flag that is false. Throws Error(usage) with `where` for a value of another kind or out of range, as the
/// program itself would. A file is looked for in `folder` unless its path is absolute; throws
/// Error(bad_input) if it is not there.
std::vector<std::string> option_words(const ToolOption& option, const Json& value, const std::string& folder,
                                      const std::string& where);

}  // namespace phos::inline study
