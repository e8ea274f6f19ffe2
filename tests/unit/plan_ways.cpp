// Of two ways of a plan the one that gains enough is kept, and the reason is told.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>

#include "core/error.h"
#include "plan/way/footprint.h"
#include "plan/way/gloss.h"
#include "support/synthetic_pilot.h"

namespace phos::test {
namespace {

/// Records that hold direct light take this part of the time; which way is kept, after how many pilots.
std::pair<bool, int> direct_way(double part, std::size_t lamps, const PlanGoal& goal,
                                PlanDirect which = PlanDirect::automatic, double unmended = 0) {
  int pilots = 0;
  Needs needs;
  const PlannedWay way = plan_direct(
      picture(), goal, which, {lamps, 8 * lamps},
      [&](const PlanTask& task) {
        ++pilots;
        Pilot pilot = synthetic_pilot(task.cached_direct ? 0 : unmended);
        for (auto& [name, p] : pilot.time.part)
          if (task.cached_direct) scale(p, part);
        return pilot;
      },
      needs);
  const auto& said = way.task.cached_direct ? needs.wanted : needs.unwanted;
  EXPECT_EQ(said.size(), which == PlanDirect::automatic ? 1u : 0u);
  return {way.task.cached_direct, pilots};
}

TEST(StudyPlan, PutsDirectLightIntoRecordsWhereThatPaysWell) {
  const PlanGoal goal{0.1, {}};
  EXPECT_EQ(direct_way(0.2, 4, goal), std::pair(true, 2));
  EXPECT_EQ(direct_way(0.5, 4, goal), std::pair(false, 2));
  EXPECT_EQ(direct_way(0.2, 3, goal), std::pair(false, 1));
  EXPECT_EQ(direct_way(2, 1, goal, PlanDirect::cached), std::pair(true, 1));
  EXPECT_EQ(direct_way(0.1, 99, goal, PlanDirect::traced), std::pair(false, 1));
  // One way out of reach leaves the other; both are refused as one is.
  const PlanGoal fine{0.02, {}};
  EXPECT_EQ(direct_way(1, 4, fine, PlanDirect::automatic, 1e-3), std::pair(true, 2));
  EXPECT_THROW(direct_way(1, 4, {{}, 0.01}), Error);
}

/// Radiance records take this part of the time; whether they are kept, after how many pilots.
std::pair<bool, int> gloss_way(double part, const PlanGoal& goal, PlanGloss which = PlanGloss::automatic,
                               const std::string& held = "harmonics hold the wall", bool lux = false,
                               double unmended = 0) {
  int pilots = 0;
  Needs needs;
  needs.held_gloss = held;
  PlanTask task = picture();
  task.lux = lux;
  const PlannedWay way = plan_gloss(
      task, goal, which,
      [&](const PlanTask& with) {
        ++pilots;
        PlannedWay made{with, synthetic_pilot(with.cached_gloss ? 0 : unmended), {}};
        for (auto& [name, p] : made.pilot.time.part)
          if (with.cached_gloss) scale(p, part);
        PlanTask image = with;
        image.lux = false;
        made.plan = make_plan(image, made.pilot, goal);
        return made;
      },
      needs);
  EXPECT_EQ(needs.wanted.size() + needs.unwanted.size(), held.empty() ? 0u : 1u);
  const auto& said = way.task.cached_gloss ? needs.wanted : needs.unwanted;
  EXPECT_EQ(said.size(), held.empty() ? 0u : 1u);
  if (!said.empty()) {
    EXPECT_EQ(said[0].why.rfind(held, 0), 0u) << said[0].why;
  }
  return {way.task.cached_gloss, pilots};
}

TEST(StudyPlan, ShowsGlossByRecordsWhereThatPays) {
  const PlanGoal goal{0.1, {}};
  EXPECT_EQ(gloss_way(0.5, goal), std::pair(true, 2));
  EXPECT_EQ(gloss_way(0.9, goal), std::pair(false, 2)) << "too little gain";
  EXPECT_EQ(gloss_way(3, goal, PlanGloss::cached), std::pair(true, 1));
  EXPECT_EQ(gloss_way(0.1, goal, PlanGloss::traced), std::pair(false, 1));
  EXPECT_EQ(gloss_way(0.1, goal, PlanGloss::automatic, ""), std::pair(false, 1)) << "nothing is held";
  EXPECT_EQ(gloss_way(0.1, goal, PlanGloss::cached, ""), std::pair(false, 1));
  EXPECT_EQ(gloss_way(0.1, goal, PlanGloss::automatic, "held", true), std::pair(false, 1)) << "sensors";
  // One way out of reach leaves the other; both are refused as one is.
  EXPECT_EQ(gloss_way(5, {0.02, {}}, PlanGloss::automatic, "held", false, 1e-3), std::pair(true, 2));
  EXPECT_THROW(gloss_way(1, {{}, 0.01}), Error);
}

/// Where the records have adaptive zones, all takes this part of the time.
struct Zones {
  double part = 1;
  double records_s = 1;  ///< times the seconds of circular records
  double unmended = 0;   ///< error that circular records leave
  std::function<void(PlanTask&)> change = [](PlanTask&) {};
  bool late = false;  ///< the pilot of adaptive zones takes too long
};

/// Whether adaptive zones are kept, after how many pilots, and the reason.
struct Kept {
  bool adaptive = false;
  int pilots = 0;
  std::string why;
};
Kept footprint_way(const Zones& zones, const PlanGoal& goal, PlanFootprint which = PlanFootprint::automatic) {
  Kept kept;
  Needs needs;
  PlanTask task = picture();
  zones.change(task);
  const auto pilot = [&](const PlanTask& with) {
    ++kept.pilots;
    if (with.adaptive && zones.late) throw PilotTooLong{99};
    Pilot made = synthetic_pilot(with.adaptive ? 0 : zones.unmended);
    scale(*made.time.find("records"), zones.records_s);
    for (auto& [name, p] : made.time.part)
      if (with.adaptive) scale(p, zones.part);
    return made;
  };
  const PlannedWay way = plan_footprint(
      task, goal, which,
      [&](const PlanTask& with, Needs&) {
        PlannedWay made{with, pilot(with), {}};
        PlanTask image = with;
        image.lux = image.by_photons = false;
        made.plan = make_plan(image, made.pilot, goal);
        return made;
      },
      pilot, needs);
  kept.adaptive = way.task.adaptive;
  EXPECT_EQ(needs.wanted.size() + needs.unwanted.size(), 1u);
  const Requirement& said = needs.wanted.empty() ? needs.unwanted.at(0) : needs.wanted.at(0);
  EXPECT_EQ(needs.wanted.empty(), !way.task.adaptive_zones());
  EXPECT_EQ(said.what, "adaptive records");
  kept.why = said.why;
  return kept;
}

TEST(StudyPlan, GivesRecordsAdaptiveZonesWhereThatPays) {
  const PlanGoal goal{0.1, {}};
  const auto expect = [&](const Kept& kept, bool adaptive, int pilots, const std::string& why) {
    EXPECT_EQ(kept.adaptive, adaptive) << kept.why;
    EXPECT_EQ(kept.pilots, pilots) << kept.why;
    EXPECT_NE(kept.why.find(why), std::string::npos) << kept.why;
  };
  expect(footprint_way({.part = 0.5}, goal), true, 2, ", with circular zones ");
  expect(footprint_way({.part = 0.9}, goal), false, 2, "; too little gain to trust the pilot");
  expect(footprint_way({.part = 3}, goal, PlanFootprint::adaptive), true, 1, "they are asked for");
  expect(footprint_way({.part = 0.1}, goal, PlanFootprint::circle), false, 1, "circular zones are asked for");
  expect(footprint_way({.part = 0.1, .late = true}, goal), false, 2, "given up");
  // Not where they cannot be, asked for or not.
  const Zones of_sensors{.part = 0.1, .change = [](PlanTask&task) { task.lux = true; }},
      of_photons{.part = 0.1, .change = [](PlanTask&task) { task.by_photons = true; }};
  for (const PlanFootprint which : {PlanFootprint::automatic, PlanFootprint::adaptive}) {
    expect(footprint_way(of_sensors, goal, which), false, 1, "each sensor has a record of its own");
    expect(footprint_way(of_photons, goal, which), false, 1, "need gathered rays");
  }
  // Records that hold direct light have them already.
  expect(footprint_way({.part = 0.1, .change = [](PlanTask& task) { task.cached_direct = true; }}, goal),
         false, 1, "records that hold direct light");
  // No second pilot for records that take next to nothing.
  expect(footprint_way({.part = 0.1, .records_s = 1e-3}, {0.2, {}}), false, 1, "not tried");
  // One way out of reach leaves the other; both are refused as one is.
  expect(footprint_way({.part = 5, .unmended = 1e-3}, {0.02, {}}), true, 2, "do not reach the goal");
  EXPECT_THROW(footprint_way({}, {{}, 0.01}), Error);
}

TEST(StudyPlan, TellsOfAdaptiveZonesWithoutAPilot) {
  PlanTask task = picture();
  Needs needs;
  EXPECT_TRUE(adaptive_untried(task, PlanFootprint::adaptive, needs));
  EXPECT_FALSE(adaptive_untried(task, PlanFootprint::automatic, needs));
  task.by_photons = true;
  EXPECT_FALSE(adaptive_untried(task, PlanFootprint::adaptive, needs));
  ASSERT_EQ(needs.unwanted.size(), 2u);
  EXPECT_EQ(needs.wanted.size(), 1u);
  EXPECT_EQ(needs.unwanted[0].why, "no pilot compares them with circular zones");
  EXPECT_EQ(needs.unwanted[1].why, "they are asked for, but adaptive zones need gathered rays");
}

}  // namespace
}  // namespace phos::test
