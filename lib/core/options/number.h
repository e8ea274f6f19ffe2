// Numbers of the command line, and what they may be.
#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>
#include <type_traits>

#include "core/error.h"
#include "core/options.h"

namespace phos {

/// "above 0", "1 to 64"; empty where all numbers are allowed.
std::string limits_text(const Range& range);

/// Throws Error(usage): what is wrong with the value of an option.
[[noreturn]] void reject_option(const std::string& name, const std::string& why);

/// All of `s`, finite and in the range; else reject_option().
template <class T>
T parse_number(const std::string& name, const std::string& s, const Range& range) {
  T v{};
  const char* begin = s.data() + (s.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, s.data() + s.size(), v);
  if (error != std::errc() || end != s.data() + s.size() || !std::isfinite(static_cast<double>(v)))
    reject_option(name,
                  text("\"", s, "\" is not ", std::is_integral_v<T> ? "a whole number" : "a number",
                       "; it must be ", limits_text(range).empty() ? "a finite number" : limits_text(range)));
  const auto wide = static_cast<double>(v);
  if (wide < range.lo || wide > range.hi || (range.lo_open && wide == range.lo))
    reject_option(name, text(s, " is out of range; it must be ", limits_text(range)));
  return v;
}

}  // namespace phos
