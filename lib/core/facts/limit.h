// A number that the code stops at. One object is the constant with which the code compares, the number in its
// errors, and the row of docs/reference/limits.md and `phos help limits`. Each module has its own in
// limits.h.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace phos {

struct Limit {
  std::string_view of;      ///< the quantity: "pixels of a picture"; Markdown of one cell
  std::int64_t most;        ///< the greatest allowed value
  std::string_view beyond;  ///< the behaviour above it: "exit code 2"

  /// The number as another type. It must hold it.
  template <class T>
  constexpr T as() const {
    return static_cast<T>(most);
  }
};

/// "2^28" for powers of two from 2^13 on, "10^8" for powers of ten from 10^5 on, else all digits.
std::string written(const Limit& limit);

/// Limits of all programs.
inline constexpr Limit kMostThreads{"threads (`--threads`)", 4096, "exit code 2"};
inline constexpr Limit kMostOptionsFileBytes{"bytes of an options file (`@FILE`)", 1 << 20, "exit code 3"};

inline constexpr const Limit* kCoreLimits[] = {&kMostThreads, &kMostOptionsFileBytes};

}  // namespace phos
