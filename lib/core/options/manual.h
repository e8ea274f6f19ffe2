// The manual page of a program.
#pragma once

#include <string>

namespace phos {

struct OptionSheet;

/// roff for man(1).
std::string manual_page(const OptionSheet& sheet);

}  // namespace phos
