#include "core/options/number.h"

namespace phos {

std::string limits_text(const Range& range) {
  const bool has_lo = std::isfinite(range.lo);
  const bool has_hi = std::isfinite(range.hi);
  if (has_lo && has_hi)
    return text(range.lo_open ? "above " : "", shortest(range.lo), " to ", shortest(range.hi));
  if (has_lo) return text(range.lo_open ? "above " : "at least ", shortest(range.lo));
  if (has_hi) return text("at most ", shortest(range.hi));
  return "";
}

void reject_option(const std::string& name, const std::string& why) {
  throw Error(ExitCode::usage, "--" + name, why);
}

}  // namespace phos
