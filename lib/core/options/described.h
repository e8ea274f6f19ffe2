// The options of a program in JSON.
#pragma once

#include "core/json.h"

namespace phos {

struct OptionSheet;

/// For programs, what --help says to people: the text of --options-json.
Json described(const OptionSheet& sheet);

}  // namespace phos
