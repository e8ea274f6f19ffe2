// A run of a plan corrects its models by its measurements, and judges what its references can tell.
#include <gtest/gtest.h>

#include "plan/run.h"
#include "support/synthetic_pilot.h"

namespace phos::test {
namespace {

TEST(StudyPlanRun, AMeasurementCorrectsThePartThatIsWrong) {
  Knobs k{};
  k.fill(64);
  double indirect = 0, rest = 0;
  for (const auto& [name, p] : synthetic_error(0).part)
    (name.starts_with("indirect") ? indirect : rest) += p.best(k);
  for (const double factor : {0.5, 4.0}) {
    PlanModel model = synthetic_error(0);
    correct(model, k, rest + factor * indirect, factor * indirect);
    EXPECT_NEAR(model.best(k), rest + factor * indirect, 1e-9 * model.best(k));
    EXPECT_NEAR(model.find("direct light and gloss, noise")->coefficients()[0], 0.02, 1e-9);
  }
  // Too much: a term that was thought to be nothing may be what it comes from. What no setting mends is let
  // be.
  PlanModel model = synthetic_error(0);
  Posynomial& noise = *model.find("indirect light, noise");
  noise.set({1, 0});
  const double before = model.best(k);
  correct(model, k, before + 0.03, before + 0.03 - rest);
  EXPECT_NEAR(noise.parts(k)[1], 0.01, 1e-6) << "one of three terms that a setting mends";
  EXPECT_EQ(model.find("indirect light, bias")->coefficients()[1], 0);
  EXPECT_NEAR(model.best(k), before + 0.03, 1e-9);
}

/// The synthetic pilot, of measurements that tell its errors to `spread` only.
Pilot doubtful_pilot(double spread) {
  Pilot pilot = synthetic_pilot(2e-4);
  for (PlanModel* model : {&*pilot.image_error, &pilot.time})
    for (auto& [name, p] : model->part) {
      std::vector<Observation> rows;
      for (const double level : {1.0, 4.0, 16.0, 64.0})
        for (const Knob knob :
             {K::photons, K::accuracy, K::rays, K::light_rays, K::records, K::pixel_samples}) {
          Knobs k{};
          k.fill(30);
          k[at(K::photons)] = 1e5, k[at(K::accuracy)] = 0.2, k[at(K::records)] = 1e4, k[at(K::pixels)] = 3e4;
          k[at(knob)] *= level;
          rows.push_back({k, p.best(k), spread * p.best(k)});
        }
      p.fit(rows, 3);
    }
  return pilot;
}

TEST(StudyPlanRun, WhatIsMeasuredIsNotDoubtedThere) {
  Pilot pilot = doubtful_pilot(0.5);
  PlanModel& errors = *pilot.image_error;
  const Knobs k = make_plan(picture(), pilot, {0.05, {}}).chosen.knobs;
  const auto width = [](const Interval& i) { return (i.high - i.low) / i.value; };
  const auto [whole, indirect] = std::pair(1.2 * errors.best(k), 0.7 * errors.best(k));
  EXPECT_GT(width(errors.predict(k, 0.2)), 0.5);
  correct(errors, k, whole, indirect);
  EXPECT_NEAR(errors.best(k), whole, 1e-9 * whole);
  EXPECT_LT(width(errors.predict(k, 0.2)), 1e-6);
  correct_time(pilot.time, k, 7);
  EXPECT_NEAR(pilot.time.best(k), 7, 1e-9);
  EXPECT_LT(width(pilot.time.predict(k, 0.2)), 1e-6);
  // The further away, the more is left to doubt.
  double before = 0;
  for (const double factor : {2.0, 4.0, 16.0}) {
    Knobs other = k;
    other[at(K::rays)] *= factor, other[at(K::photons)] *= factor, other[at(K::light_rays)] *= factor;
    EXPECT_GT(width(errors.predict(other, 0.2)), before);
    before = width(errors.predict(other, 0.2));
  }
}

TEST(StudyPlanRun, ANearMissAsksForLittleMore) {
  Pilot pilot = doubtful_pilot(0.5);
  const double asked = 0.03, found = 1.1 * asked;
  const Prediction first = make_plan(picture(), pilot, {asked, {}}).chosen;
  double indirect = 0;
  for (const auto& [name, p] : pilot.image_error->part)
    if (name.starts_with("indirect")) indirect += p.best(first.knobs);
  const double part = indirect / pilot.image_error->best(first.knobs);
  correct(*pilot.image_error, first.knobs, found * found, part * found * found);
  std::vector<PlanRound> rounds{{first, 1, MeasuredError{}, {}, 0}};
  rounds[0].image->relative_rmse = found;
  const std::optional<Prediction> next = next_try(picture(), pilot, asked, rounds);
  ASSERT_TRUE(next);
  EXPECT_LT(next->error(), 0.85 * asked);
  EXPECT_GT(next->error(), 0.5 * asked);
  // A mean square of (0.85 / 1.1)^2 costs 1.7 times as much, more where a part of it cannot be mended.
  EXPECT_LT(next->seconds.value, 4 * first.seconds.value);
  // A second miss says that the model is wrong: aim for less.
  rounds.push_back(rounds[0]);
  rounds[1].predicted = *next;
  const std::optional<Prediction> third = next_try(picture(), pilot, asked, rounds);
  ASSERT_TRUE(third);
  EXPECT_LT(third->error(), next->error());
}

/// Records take nearly all of the time and are good enough; direct light is what misses.
TEST(StudyPlanRun, AnotherRoundKeepsRecordsThatWillDo) {
  Pilot pilot = synthetic_pilot();
  const double asked = 0.03, found = 1.2 * asked;
  const Prediction first = make_plan(picture(), pilot, {0.6 * asked, {}}).chosen;
  pilot.time.find("records")->set({1e-3});
  double indirect = 0;
  for (const auto& [name, p] : pilot.image_error->part)
    if (name.starts_with("indirect")) indirect += p.best(first.knobs);
  correct(*pilot.image_error, first.knobs, found * found, indirect);
  std::vector<PlanRound> rounds{{first, 1, MeasuredError{}, {}, 0}};
  rounds[0].image->relative_rmse = found;
  std::optional<Prediction> next = next_try(picture(), pilot, asked, rounds);
  ASSERT_TRUE(next);
  for (const Knob knob : {K::photons, K::accuracy, K::rays, K::records})
    EXPECT_EQ(next->knobs[at(knob)], first.knobs[at(knob)]) << name_of(knob);
  EXPECT_GT(next->knobs[at(K::light_rays)], first.knobs[at(K::light_rays)]);
  EXPECT_NEAR(next->seconds.value, pilot.time.find("picture")->best(next->knobs), 1e-6);
  // Where records are what misses, others are made, of the same photons or not.
  pilot.image_error = synthetic_error(0);
  correct(*pilot.image_error, first.knobs, found * found,
          found * found - pilot.image_error->best(first.knobs) + indirect);
  next = next_try(picture(), pilot, asked, rounds);
  ASSERT_TRUE(next);
  EXPECT_NE(next->knobs[at(K::records)] * next->knobs[at(K::rays)],
            first.knobs[at(K::records)] * first.knobs[at(K::rays)]);
  EXPECT_NEAR(next->seconds.value,
              pilot.time.best(next->knobs) - (next->knobs[at(K::photons)] == first.knobs[at(K::photons)]
                                                  ? pilot.time.find("photons")->best(next->knobs)
                                                  : 0),
              1e-6);
}

/// Of the larger error and the coarser reference.
TEST(PlanRound, CoarseReferencesJudgeOnlyThatAnErrorIsLarge) {
  const auto judged = [](double error, double resolution, double asked) {
    PlanRound round;
    round.image.emplace(), round.lux.emplace();
    round.image->relative_rmse = error, round.lux->resolution = resolution;
    return round.judged(asked);
  };
  EXPECT_TRUE(judged(0.01, 0.02, 0.02)) << "met";
  EXPECT_TRUE(judged(0.05, 0.02, 0.02)) << "missed";
  EXPECT_TRUE(judged(0.05, 0.03, 0.02)) << "missed, by more than the references feign";
  EXPECT_FALSE(judged(0.025, 0.03, 0.02)) << "missed, or noise of the references";
  EXPECT_FALSE(judged(0.01, 0.03, 0.02)) << "met, or luck";
}

/// More samples of references for what they cannot tell, or not surely enough.
TEST(PlanRound, ReferencesAreMadeBetterWhereTheirNoiseWouldDecide) {
  const auto times = [](double error, double stderr_of_it, double resolution) {
    MeasuredError e;
    e.relative_rmse = error, e.rmse_stderr = stderr_of_it, e.resolution = resolution;
    return times_as_many(e, 0.02);
  };
  EXPECT_EQ(times(0.015, 0.001, 0.01), 1) << "met";
  EXPECT_EQ(times(0.03, 0.001, 0.01), 1) << "missed";
  EXPECT_EQ(times(0.022, 0.001, 0.01), 4) << "missed, perhaps";
  EXPECT_EQ(times(0.019, 0.001, 0.01), 4) << "met, perhaps";
  EXPECT_DOUBLE_EQ(times(0.05, 0.001, 0.04), 16) << "they cannot tell it";
  EXPECT_DOUBLE_EQ(times(0.02, 0.001, 0.03), 9) << "nor that it is near";
}

}  // namespace
}  // namespace phos::test
