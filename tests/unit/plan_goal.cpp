// Plans of a synthetic pilot keep what they promise.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "estimate/hemisphere/hemisphere.h"
#include "plan/calibration.h"
#include "support/synthetic_pilot.h"

namespace phos::test {
namespace {

TEST(StudyPlan, MeetsTheErrorAtTheLeastCost) {
  const Pilot pilot = synthetic_pilot();
  double before = 0;
  for (const double asked : {0.2, 0.1, 0.05, 0.02}) {
    const Plan plan = make_plan(picture(), pilot, {asked, {}});
    EXPECT_LE(plan.chosen.error_to_meet(), asked);
    EXPECT_GT(plan.chosen.error(), 0.4 * asked) << "dearer than need be";
    EXPECT_GE(plan.chosen.seconds.value, before);
    before = plan.chosen.seconds.value;
    EXPECT_TRUE(plan.warnings.empty());
    for (const PlanPoint& p : front_of(picture(), pilot)) {
      const Prediction q = predict(picture(), pilot, p.knobs);
      EXPECT_TRUE(q.error_to_meet() > asked ||
                  (1 + calibration::kNextToNothing) * q.seconds.value >= plan.chosen.seconds.value);
    }
  }
}

/// The rays of a plan's records, and of a pilot's, are those that are shot: whole rings of a hemisphere. Of
/// 48 asked for 27 are, and a model would take their noise for that of 48.
TEST(StudyPlan, NoRayOfARecordIsPromisedThatIsNotShot) {
  const auto shot = [](const Knobs& k) {
    return static_cast<double>(cells_of(rings_for(std::llround(k[at(K::rays)]))));
  };
  const std::vector<PlanPoint> front = front_of(picture(), synthetic_pilot());
  for (const PlanPoint& p : front) EXPECT_EQ(p.knobs[at(K::rays)], shot(p.knobs));
  EXPECT_EQ(front.front().knobs[at(K::rays)], 12) << "two rings, as few as may be asked for";
  for (const bool image : {false, true})
    for (const Knobs& k : pilot_caches(image)) EXPECT_EQ(k[at(K::rays)], shot(k));
}

/// A few rays more than the model asks for, where they cost next to nothing: small pilots do not see rare
/// bright pixels.
TEST(StudyPlan, TakesEnoughRaysWhereTheyAreCheap) {
  Pilot dear = synthetic_pilot(), cheap = dear;
  const auto shadows = [](double cost) {
    return known({{"start", {}}, {"shadows", {{K::pixels, 1}, {K::light_rays, 1}}}}, {1, cost});
  };
  *dear.time.find("picture") = shadows(1e-5), *cheap.time.find("picture") = shadows(1e-8);
  const Knobs few = make_plan(picture(), dear, {0.2, {}}).chosen.knobs,
              more = make_plan(picture(), cheap, {0.2, {}}).chosen.knobs;
  EXPECT_LT(few[at(K::light_rays)], 8);
  EXPECT_EQ(more[at(K::light_rays)], 16);
  EXPECT_EQ(few[at(K::photons)], more[at(K::photons)]);
  // What needs more has as many as it needs.
  EXPECT_GT(make_plan(picture(), cheap, {0.02, {}}).chosen.knobs[at(K::light_rays)], 16);
}

/// Samples at edges share the shadow rays of their pixel: more of them than those light makes noise, and is
/// not taken, though it costs nothing.
TEST(StudyPlan, LeavesSamplesThatWouldAddToTheError) {
  for (const bool shared : {false, true}) {
    Pilot pilot = synthetic_pilot();
    if (shared)
      *pilot.image_error->find("direct light and gloss, noise") =
          known({{"shadow rays at edges", {{K::light_rays, -2}, {K::edge_samples, 1}}}}, {0.02});
    const Knobs k = make_plan(picture(), pilot, {0.2, {}}).chosen.knobs;
    EXPECT_EQ(k[at(K::edge_samples)], shared ? k[at(K::pixel_samples)] : 16);
  }
}

TEST(StudyPlan, KeepsTheTimeWithTheLeastError) {
  const Pilot pilot = synthetic_pilot();
  double before = 1;
  for (const double seconds : {1.0, 4.0, 16.0, 64.0}) {
    const Plan plan = make_plan(picture(), pilot, {{}, seconds});
    EXPECT_LE(plan.chosen.seconds.high, seconds);
    EXPECT_GT(plan.chosen.seconds.value, 0.3 * seconds);
    EXPECT_LT(plan.chosen.error(), before);
    before = plan.chosen.error();
  }
}

std::string refusal(const Pilot& pilot, const PlanGoal& goal) {
  try {
    make_plan(picture(), pilot, goal);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    return e.where() + ": " + e.what();
  }
  return "";
}

TEST(StudyPlan, SaysWhatCannotBeHad) {
  EXPECT_NE(refusal(synthetic_pilot(1e-3), {0.02, {}}).find("--error: 2 % is out of reach"),
            std::string::npos);
  EXPECT_EQ(refusal(synthetic_pilot(1e-3), {0.1, {}}), "");
  EXPECT_NE(refusal(synthetic_pilot(), {{}, 0.01}).find("--seconds: no settings keep within 0.01 s"),
            std::string::npos);
  EXPECT_NE(refusal(synthetic_pilot(), {0.02, 0.5}).find("--seconds: 2 % takes about"), std::string::npos);
  // What no setting mends is 2.2 % by the best guess, but may be nothing.
  Pilot unsure = synthetic_pilot();
  Posynomial& bias = *unsure.image_error->find("indirect light, bias");
  bias = Posynomial({{"interpolation", {{K::accuracy, 2}}}, {"what no setting mends", {}}});
  Knobs coarse{}, fine{};
  coarse.fill(1), fine.fill(1);
  coarse[at(K::accuracy)] = 0.5, fine[at(K::accuracy)] = 0.25;
  bias.fit(std::vector<Observation>{{coarse, 1e-3, 4e-4}, {fine, 6e-4, 4e-4}}, 1);
  ASSERT_GT(bias.coefficients()[1], 1e-4);
  const Plan hoped = make_plan(picture(), unsure, {0.02, {}});
  EXPECT_EQ(hoped.warnings.size(), 1u);
  EXPECT_LT(hoped.chosen.error_low(), 0.02);
  EXPECT_GT(hoped.chosen.error(), 0.02);
  // At 1.6 %, what is asked is within the best guess, if not with kMargin.
  bias.fit(std::vector<Observation>{{coarse, 6.3e-4, 2e-4}, {fine, 3.3e-4, 2e-4}}, 1);
  ASSERT_GT(bias.coefficients()[1], 1.6e-4);
  const Plan barely = make_plan(picture(), unsure, {0.02, {}});
  EXPECT_EQ(barely.warnings.size(), 1u);
  EXPECT_LE(barely.chosen.error(), 0.02);
  Pilot blurred = synthetic_pilot();
  blurred.image_resolution = 0.04;
  const Plan plan = make_plan(picture(), blurred, {0.02, {}});
  ASSERT_EQ(plan.warnings.size(), 1u);
  EXPECT_NE(plan.warnings[0].find("tell no error below 4 % from none"), std::string::npos)
      << plan.warnings[0];
}

}  // namespace
}  // namespace phos::test
