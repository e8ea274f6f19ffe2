// The options of a program in JSON.
#pragma once

#include "core/json.h"

namespace phos {

struct OptionSheet;

/// The content of --help, for programs: the text of --options-json.
Json described(const OptionSheet& sheet);

}  // namespace phos
