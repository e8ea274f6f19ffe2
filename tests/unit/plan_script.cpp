// A plan as people and as programs read it.
#include <gtest/gtest.h>

#include "core/text/quantity.h"
#include "plan/json.h"
#include "plan/text.h"
#include "support/synthetic_pilot.h"

namespace phos::test {
namespace {

TEST(StudyPlan, TheScriptHoldsPredictionAndReasons) {
  PlanTask task = picture();
  task.camera = "it's";
  const Pilot pilot = synthetic_pilot();
  const PlanGoal goal{0.05, {}};
  const Plan plan = make_plan(task, pilot, goal);
  Needs needs;
  needs.wanted = {{"global photons", "because"}}, needs.unwanted = {{"temporal data", "nothing moves"}};
  const std::string s = plan_script(task, needs, pilot, goal, plan, 7);
  for (const char* part :
       {"#!/usr/bin/env bash\n", "# Asked for: image of 200 x 150 from camera it's, error at most 5 %",
        "# Predicted: error of the image ", "global photons: because", "temporal data: nothing moves",
        "scene='a room.glb'\n", "phos-photons \"$scene\" --photons ",
        "phos-irradiance \"$scene\" \"$out/light.photons\" --place view", "--camera 'it'\\''s'", "--seed 7",
        "-o \"$out/image.exr\"\n", "set -euo pipefail\n"})
    EXPECT_NE(s.find(part), std::string::npos) << part << "\n" << s;
  EXPECT_EQ(s.find("phos-sense"), std::string::npos);
  for (std::size_t start = 0; start < s.size();) {
    const std::size_t end = s.find('\n', start);
    EXPECT_LE(end - start, 125u) << s.substr(start, end - start);
    start = end + 1;
  }
}

TEST(StudyPlan, JsonHoldsTheSame) {
  PlanTask task = picture();
  const Pilot pilot = synthetic_pilot();
  const Plan plan = make_plan(task, pilot, {0.05, {}});
  const Json j = plan_json(task, {}, pilot, {0.05, {}}, plan, 0);
  EXPECT_EQ(j.find("plan")->find("settings")->find("photons")->as_number(),
            plan.chosen.knobs[at(K::photons)]);
  EXPECT_EQ(j.find("plan")->find("image_error")->find("high")->as_number(), plan.chosen.image->high);
  ASSERT_EQ(j.find("stages")->as_array().size(), 3u);
  EXPECT_EQ(j.find("stages")->as_array()[2].find("tool")->as_string(), "phos-splat");
  EXPECT_EQ(j.find("other_errors")->as_array().size(), 5u);
  EXPECT_FALSE(j.find("plan")->find("settings")->find("footprint"));
  task.adaptive = true;
  const Json adaptive = plan_json(task, {}, pilot, {0.05, {}}, plan, 0);
  EXPECT_EQ(adaptive.find("plan")->find("settings")->find("footprint")->as_string(), "adaptive");
}

TEST(StudyPlan, FiguresForPeople) {
  EXPECT_EQ(percent(0.05), "5 %");
  EXPECT_EQ(percent(0.0123), "1.2 %");
  EXPECT_EQ(percent(0.2), "20 %");
  EXPECT_EQ(duration(1.26), "1.3 s");
  EXPECT_EQ(duration(42.4), "42 s");
  EXPECT_EQ(duration(150), "2 min 30 s");
}

}  // namespace
}  // namespace phos::test
