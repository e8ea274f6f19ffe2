// Bytes that stand as text (RFC 4648).
#pragma once

#include <string>
#include <string_view>

namespace phos::test {

/// Up to the first character that is no digit: "=", "<".
inline std::string bytes_from_base64(std::string_view text) {
  std::string bytes;
  unsigned value = 0;
  int bits = 0;
  for (const char c : text) {
    const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos) break;
    value = value << 6 | static_cast<unsigned>(digit);
    if ((bits += 6) >= 8) bits -= 8, bytes += static_cast<char>(value >> bits & 255);
  }
  return bytes;
}

}  // namespace phos::test
