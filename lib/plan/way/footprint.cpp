#include "plan/way/footprint.h"

#include <optional>

#include "core/error.h"
#include "plan/calibration.h"
#include "plan/way/gain.h"

namespace phos::inline plan {
namespace {

constexpr const char* kWhat = "adaptive records";

PlanTask with_zones(PlanTask task, bool adaptive) {
  task.adaptive = adaptive;
  return task;
}

bool possible(const PlanTask& task) { return !task.lux && !task.by_photons; }

/// What `make` makes; nothing, and the first refusal, where the goal is out of reach.
template <class Make>
std::optional<PlannedWay> attempt(const Make& make, std::optional<Error>& refused) {
  try {
    return make();
  } catch (const Error& e) {
    if (e.code() != ExitCode::usage) throw;
    if (!refused) refused = e;
    return {};
  }
}

/// The plan of a pilot in whose scene records take no time and have no error: no zones do better.
Prediction without_records(const PlannedWay& way, const PlanGoal& goal) {
  Pilot pilot = way.pilot;
  const auto remove = [](Posynomial& p) {
    for (std::size_t guess = 0; guess <= Posynomial::kBest; ++guess) p.scale(guess, 0);
  };
  remove(*pilot.time.find("records"));
  for (auto& [name, p] : pilot.image_error->part)
    if (name.starts_with("indirect")) remove(p);
  return make_plan(way.task, pilot, goal).chosen;
}

}  // namespace

bool adaptive_untried(const PlanTask& task, PlanFootprint which, Needs& needs) {
  const bool asked = which == PlanFootprint::adaptive, made = asked && possible(task);
  std::string why = asked                            ? "they are asked for"
                    : which == PlanFootprint::circle ? "circular zones are asked for"
                                                     : "no pilot compares them with circular zones";
  if (!possible(task))
    why = text(asked ? "they are asked for, but " : "",
               task.lux ? "each sensor has a record of its own" : "adaptive zones need gathered rays");
  (made ? needs.wanted : needs.unwanted).push_back({kWhat, why});
  return made;
}

PlannedWay plan_footprint(const PlanTask& task, const PlanGoal& goal, PlanFootprint which,
                          const std::function<PlannedWay(const PlanTask&, Needs&)>& ways,
                          const std::function<Pilot(const PlanTask&)>& pilot, Needs& needs) {
  const auto say = [&](bool wanted, const std::string& why) {
    (wanted ? needs.wanted : needs.unwanted).push_back({kWhat, why});
  };
  if (which != PlanFootprint::automatic || !possible(task))
    return ways(with_zones(task, adaptive_untried(task, which, needs)), needs);
  std::optional<Error> refused;
  Needs told = needs;  // of a way that reaches the goal
  std::optional<PlannedWay> round = attempt([&] { return ways(with_zones(task, false), told); }, refused);
  if (!round) {
    if (!goal.error) throw *refused;  // adaptive zones do not make the cheapest plan cheaper
    std::optional<PlannedWay> shaped;
    try {
      shaped = attempt([&] { return ways(with_zones(task, true), needs); }, refused);
    } catch (const PilotTooLong&) {
      throw *refused;
    }
    if (!shaped) throw *refused;
    say(true, "circular zones do not reach the goal");
    return *std::move(shaped);
  }
  needs = std::move(told);
  if (round->task.cached_direct) {
    say(true, "for records that hold direct light");
    return *std::move(round);
  }
  const Prediction& usual = round->plan.chosen;
  if (!pays(without_records(*round, goal), usual, goal, calibration::kLeastFootprintGain)) {
    say(false, "not tried: records take and leave too little of the time and of the error");
    return *std::move(round);
  }
  std::optional<PlannedWay> shaped;
  try {
    shaped = attempt(
        [&] {
          PlannedWay way{with_zones(round->task, true), {}, {}};
          way.pilot = pilot(way.task);
          way.plan = make_plan(way.task, way.pilot, goal);
          return way;
        },
        refused);
  } catch (const PilotTooLong& late) {
    say(false, text("their pilot was given up after ", duration(late.seconds)));
    return *std::move(round);
  }
  if (!shaped) {
    say(false, "they do not reach the goal");
    return *std::move(round);
  }
  const bool better = pays(shaped->plan.chosen, usual, goal, calibration::kLeastFootprintGain);
  say(better, text(figures(shaped->plan.chosen), ", with circular zones ", figures(usual),
                   better ? "" : "; too little gain to trust the pilot"));
  return better ? *std::move(shaped) : *std::move(round);
}

}  // namespace phos::inline plan
