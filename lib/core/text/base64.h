// Bytes as text.
#pragma once

#include <string>
#include <string_view>

namespace phos {

/// RFC 4648, section 4: with "+", "/" and "=", without line breaks.
std::string base64(std::string_view bytes);

}  // namespace phos
