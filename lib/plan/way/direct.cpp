#include "plan/way/direct.h"

#include "core/error.h"
#include "plan/calibration.h"
#include "plan/way/gain.h"

namespace phos::inline plan {
namespace {

constexpr const char* kWhat = "direct light in the records";

PlannedWay way_of(PlanTask task, bool cached, const PlanGoal& goal,
                  const std::function<Pilot(const PlanTask&)>& pilot) {
  task.cached_direct = cached;
  PlannedWay way{task, pilot(task), {}};
  way.plan = make_plan(way.task, way.pilot, goal);
  return way;
}

}  // namespace

LampCount count_lamps(const Scene& scene) {
  LampCount count;
  for (const Light& light : scene.light) {
    count.lamps += light.extended();
    if (light.kind == Light::Kind::area) count.facets += scene.instance[light.instance].triangle_count;
  }
  return count;
}

PlannedWay plan_direct(const PlanTask& task, const PlanGoal& goal, PlanDirect which, const LampCount& lamps,
                       const std::function<Pilot(const PlanTask&)>& pilot, Needs& needs) {
  if (which != PlanDirect::automatic) return way_of(task, which == PlanDirect::cached, goal, pilot);
  if (task.lux || lamps.lamps < calibration::kManyLamps) {
    const char* why =
        task.lux ? "sensors send shadow rays in any case" : "not tried: few lamps take few shadow rays";
    needs.unwanted.push_back({kWhat, why});
    return way_of(task, false, goal, pilot);
  }
  std::optional<PlannedWay> ways[2];
  std::optional<Error> refused;
  for (const bool cached : {false, true}) {
    try {
      ways[cached] = way_of(task, cached, goal, pilot);
    } catch (const Error& e) {
      if (e.code() != ExitCode::usage) throw;
      if (!refused) refused = e;
    }
  }
  if (!ways[0] && !ways[1]) throw *refused;
  const std::string many = text(lamps.lamps, " lamps of ", lamps.facets, " facets");
  if (!ways[0] || !ways[1]) {
    const bool cached = ways[1].has_value();
    (cached ? needs.wanted : needs.unwanted)
        .push_back({kWhat, text(many, cached ? ": shadow rays do not reach the goal"
                                             : ": it does not reach the goal")});
    return *std::move(ways[cached]);
  }
  const bool cached = pays(ways[1]->plan.chosen, ways[0]->plan.chosen, goal, calibration::kLeastGain);
  (cached ? needs.wanted : needs.unwanted)
      .push_back(
          {kWhat, text(many, ": ", figures(ways[1]->plan.chosen), ", with shadow rays ",
                       figures(ways[0]->plan.chosen), cached ? "" : "; too little gain to trust the pilot")});
  return *std::move(ways[cached]);
}

}  // namespace phos::inline plan
