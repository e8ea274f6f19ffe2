#include "core/counters.h"

#include "core/error.h"
#include "core/json.h"

namespace phos {

std::uint64_t Counters::operator[](const std::string& event) const {
  const auto found = counts_.find(event);
  return found == counts_.end() ? 0 : found->second;
}

void Counters::require_at_most(const std::string& event, double fraction, std::uint64_t trials,
                               const std::string& remedy) const {
  const std::uint64_t n = (*this)[event];
  if (static_cast<double>(n) <= fraction * static_cast<double>(trials)) return;
  throw Error(ExitCode::numerical, "",
              text(event, ": ", n, " of ", trials, ", more than the allowed share of ", shortest(fraction),
                   "; ", remedy));
}

}  // namespace phos
