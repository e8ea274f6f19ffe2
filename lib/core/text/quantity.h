// Quantities in words.
#pragma once

#include <string>

namespace phos {

/// "4.2 %"
std::string percent(double share);
/// "12.3 %", "4 %"
std::string percent_to_tenths(double share);
/// "12 s", "1 min 20 s"
std::string duration(double seconds);

}  // namespace phos
