// Whether a plan's records are made by gathered rays or of photons alone.
#pragma once

#include <vector>

#include "plan/requirements.h"
#include "plan/task.h"
#include "scene/report/light_ways.h"

namespace phos::inline plan {

enum class PlanRecords { automatic, gather, hull };

/// Of photons alone? automatic: where rays of records would leave out light that photons bring, however many
/// they are (scene/report/unsampled.h), unless sensors hang in free air, where no photon lands. Else
/// by rays, which are less noisy. Says in `needs` why.
bool by_photons(PlanRecords which, const std::vector<LightWay>& ways, const PlanTask& task, Needs& needs);

}  // namespace phos::inline plan
