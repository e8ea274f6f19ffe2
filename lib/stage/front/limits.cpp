#include "stage/front/limits.h"

#include <vector>

#include "core/text/markdown.h"
#include "direct/limits.h"
#include "file/limits.h"
#include "hsh/limits.h"
#include "photon/limits.h"
#include "reference/limits.h"
#include "scene/limits.h"
#include "sense/limits.h"
#include "splat/limits.h"
#include "study/limits.h"
#include "view/limits.h"

namespace phos::stage {
namespace {

constexpr LimitGroup kGroups[] = {
    {"Scenes and pictures", kSceneLimits},
    {"Light", kPhotonLimits},
    {"Light", kDirectLimits},
    {"Light", kHshLimits},
    {"Light", kSplatLimits},
    {"Light", kReferenceLimits},
    {"Sensors", kSenseLimits},
    {"Studies", kStudyLimits},
    {"Views", kViewLimits},
    {"Files", kFileLimits},
    {"Command lines", kCoreLimits},
};

}  // namespace

std::span<const LimitGroup> all_limits() { return kGroups; }

std::string limit_table() {
  std::vector<std::vector<std::string>> rows;
  for (const LimitGroup& group : kGroups)
    for (const Limit* limit : group.limits)
      rows.push_back({std::string(limit->of), written(*limit), std::string(limit->beyond)});
  return markdown_table({"quantity", "at most", "beyond"}, rows);
}

}  // namespace phos::stage
