// Settings that are usual for an error: whole, in the range of their options, and finer for less error.
#include <gtest/gtest.h>

#include <cmath>

#include "estimate/hemisphere/hemisphere.h"
#include "plan/usual.h"

namespace phos::test {
namespace {

TEST(UsualSettings, AreWholeAndGrowAsTheErrorShrinks) {
  PlanTask task;
  task.gloss = true;
  Knobs coarser{};
  for (const double error : {1.0, 0.2, 0.1, 0.05, 0.02, 0.01, 0.001}) {
    const Knobs k = usual_knobs(task, error, 1);
    for (const Knob knob : {Knob::photons, Knob::rays, Knob::pixel_samples, Knob::edge_samples,
                            Knob::light_rays, Knob::gloss_rays, Knob::sensor_rays}) {
      const double v = k[at(knob)];
      EXPECT_EQ(v, std::floor(v)) << name_of(knob) << " " << error;
      EXPECT_GE(v, std::max(1.0, coarser[at(knob)])) << name_of(knob) << " " << error;
    }
    EXPECT_GT(k[at(Knob::accuracy)], 0) << error;
    EXPECT_LE(k[at(Knob::accuracy)], coarser[at(Knob::accuracy)] > 0 ? coarser[at(Knob::accuracy)] : 1)
        << error;
    EXPECT_GE(k[at(Knob::light_rays)], k[at(Knob::pixel_samples)]) << error;
    EXPECT_EQ(std::fmod(k[at(Knob::gloss_rays)], k[at(Knob::pixel_samples)]), 0) << error;
    int rings = 1;
    while (cells_of(rings) < static_cast<std::int64_t>(k[at(Knob::rays)])) ++rings;
    EXPECT_EQ(static_cast<double>(cells_of(rings)), k[at(Knob::rays)]) << error;
    coarser = k;
  }
  // Many lamps share the shadow rays of a pixel.
  EXPECT_LT(usual_knobs(task, 0.05, 16)[at(Knob::light_rays)],
            usual_knobs(task, 0.05, 1)[at(Knob::light_rays)]);
}

TEST(UsualSettings, PredictNothing) {
  PlanGoal goal;
  goal.seconds = 10;
  const Plan plan = usual_plan({}, goal, 0.05, 1, "no pilot");
  EXPECT_FALSE(plan.predicted);
  EXPECT_EQ(plan.warnings, std::vector<std::string>{"no pilot"});
  EXPECT_EQ(plan.chosen.knobs, usual_knobs({}, 0.05, 1));
}

TEST(UsualSettings, EndWherePhotonsEnd) {
  PlanGoal goal;
  goal.error = 0.004;
  EXPECT_LT(usual_plan({}, goal, 0.05, 1, "").chosen.knobs[at(Knob::photons)], 5e7);
  goal.error = 0.0036;
  EXPECT_THROW(usual_plan({}, goal, 0.05, 1, ""), Error);
}

}  // namespace
}  // namespace phos::test
