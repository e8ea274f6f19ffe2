// The text of --help.
#pragma once

#include <string>

namespace phos {

struct OptionSheet;

std::string help_text(const OptionSheet& sheet);

}  // namespace phos
