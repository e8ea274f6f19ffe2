// Messages of one line.
#pragma once

#include <string>

namespace phos {

/// Control characters, newlines among them, become spaces; those at the end go.
std::string one_line(std::string s);

}  // namespace phos
