#include "plan/way/gloss.h"

#include <optional>

#include "core/error.h"
#include "plan/calibration.h"
#include "plan/way/gain.h"

namespace phos::inline plan {
namespace {

constexpr const char* kWhat = "radiance records";

}  // namespace

PlannedWay plan_gloss(const PlanTask& task, const PlanGoal& goal, PlanGloss which,
                      const std::function<PlannedWay(const PlanTask&)>& direct, Needs& needs) {
  const auto way = [&](bool cached) {
    PlanTask with = task;
    with.cached_gloss = cached;
    return direct(with);
  };
  const auto say = [&](bool wanted, const std::string& why) {
    (wanted ? needs.wanted : needs.unwanted).push_back({kWhat, text(needs.held_gloss, why)});
  };
  if (needs.held_gloss.empty()) return way(false);  // tell_of_gloss() has told why
  if (which != PlanGloss::automatic) {
    const bool cached = which == PlanGloss::cached;
    say(cached, cached ? "" : ", but rays are asked for");
    return way(cached);
  }
  if (task.lux) {
    say(false, "; not tried, because sensors see no gloss");
    return way(false);
  }
  std::optional<PlannedWay> traced, cached;
  std::optional<Error> refused;
  const auto attempt = [&](bool by_records, std::optional<PlannedWay>& made) {
    try {
      made = way(by_records);
    } catch (const Error& e) {
      if (e.code() != ExitCode::usage) throw;
      if (!refused) refused = e;
    }
  };
  attempt(false, traced);
  if (traced && traced->task.cached_direct) {
    say(false, "; not tried, because records hold the direct light");
    return *std::move(traced);
  }
  try {
    attempt(true, cached);
  } catch (const PilotTooLong& late) {
    if (!traced) throw;
    say(false, text("; their pilot was given up after ", duration(late.seconds)));
    return *std::move(traced);
  }
  if (!traced && !cached) throw *refused;
  if (!traced || !cached) {
    say(cached.has_value(), cached ? "; rays do not reach the goal" : "; records do not reach the goal");
    return cached ? *std::move(cached) : *std::move(traced);
  }
  const Prediction &records = cached->plan.chosen, &rays = traced->plan.chosen;
  const bool better = pays(records, rays, goal, calibration::kLeastGlossGain);
  say(better, text(": ", figures(records), ", by rays ", figures(rays),
                   better ? "" : "; too little gain to trust the pilot"));
  return better ? *std::move(cached) : *std::move(traced);
}

}  // namespace phos::inline plan
