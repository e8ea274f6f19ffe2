#include "plan/estimate.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "scene/report/unsampled.h"

namespace phos::inline plan {

bool by_photons(PlanRecords which, const std::vector<LightWay>& ways, const PlanTask& task, Needs& needs) {
  constexpr const char* kWhat = "records of photons alone";
  if (which == PlanRecords::hull) {
    needs.wanted.push_back({kWhat, "they are asked for"});
    return true;
  }
  constexpr double kAnyNumber = std::numeric_limits<double>::max();
  const std::vector<LightWay> missed = unsampled(ways, Sampler::gathering_beside_caustics, kAnyNumber);
  if (missed.empty()) {
    needs.unwanted.push_back({kWhat, "gathered rays are less noisy, and find all light that matters"});
    return false;
  }
  const std::string light = share_text(missed.front());
  const bool in_air = std::find(task.grid.begin(), task.grid.end(), "--height") != task.grid.end();
  if (which == PlanRecords::gather || in_air) {
    const char* why = in_air ? "sensors hang where no photon lands" : "gathered rays are asked for";
    needs.unwanted.push_back({kWhat, text(why, ", though they leave out ", light)});
    return false;
  }
  needs.wanted.push_back({kWhat, text("gathered rays would leave out ", light)});
  return true;
}

}  // namespace phos::inline plan
