// Characters of UTF-8 (RFC 3629).
#pragma once

#include <cstddef>
#include <string_view>

namespace phos {

/// Length in bytes of the well-formed character that starts at s[i], i < s.size(); 0 if none starts there.
std::size_t utf8_length(std::string_view s, std::size_t i);

}  // namespace phos
