#include "core/counters.h"

#include "core/error.h"
#include "core/json.h"

namespace phos {

std::uint64_t Counters::operator[](const std::string& event) const {
  const auto found = counts_.find(event);
  return found == counts_.end() ? 0 : found->second;
}

void Counters::require_allowed(const Event& event, std::uint64_t trials) const {
  const std::uint64_t n = (*this)[event], allowed = allowed_count(trials, event.share);
  if (event.share == 1 || n <= allowed) return;
  throw Error(ExitCode::numerical, "",
              text(event.name, ": ", n, " in ", trials, ' ', event.trials, ", where at most ", allowed,
                   " are allowed (a share of ", shortest(event.share), "); ", event.remedy));
}

}  // namespace phos
