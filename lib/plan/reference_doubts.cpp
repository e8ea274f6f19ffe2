#include "plan/reference_doubts.h"

#include <algorithm>

#include "core/error.h"
#include "plan/plan.h"

namespace phos::inline plan {

void ReferenceDoubts::add(const Json& stats, double places) {
  if (const Json* ways = stats.find("unsampled")) unsampled_ = light_ways_from(*ways);
  const Json* untrusted = stats.find("untrusted");
  if (untrusted && untrusted->is_number() && places > 0)
    untrusted_share_ = std::max(untrusted_share_, untrusted->as_number() / places);
}

std::vector<std::string> ReferenceDoubts::lines() const {
  std::vector<std::string> out;
  for (const LightWay& way : unsampled_) out.push_back(text("references do not show ", share_text(way)));
  if (too_few_bright())
    out.push_back(text("too few bright paths make the light of the references at ", percent(untrusted_share_),
                       " of the places"));
  return out;
}

}  // namespace phos::inline plan
