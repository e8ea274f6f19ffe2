// Models of a plan: fits find coefficients that are known, and say how sure they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "plan/fit.h"
#include "plan/pilot/models.h"
#include "plan/pilot/pilot.h"

namespace phos {
namespace {

double normal(RandomStream& random) {
  return std::sqrt(-2 * std::log(1 - random.uniform_double())) *
         std::cos(2 * std::numbers::pi * random.uniform_double());
}

TEST(StudyPlanFit, FindsCoefficientsExactly) {
  // y = 3 + 0.5 x + 0 x^2, at five places.
  std::vector<FitRow> rows;
  for (const double x : {1.0, 2.0, 4.0, 8.0, 16.0}) rows.push_back({{1, x, x * x}, 3 + 0.5 * x, 0.1});
  const std::vector<double> c = fit_nonnegative(rows);
  ASSERT_EQ(c.size(), 3u);
  EXPECT_NEAR(c[0], 3, 1e-9);
  EXPECT_NEAR(c[1], 0.5, 1e-9);
  EXPECT_NEAR(c[2], 0, 1e-9);
}

TEST(StudyPlanFit, DoesNotDependOnUnits) {
  for (const double unit : {1e-12, 1e-6, 1e6, 1e12}) {
    std::vector<FitRow> rows;
    for (const double x : {1.0, 2.0, 4.0, 8.0})
      rows.push_back({{1 / unit, x * unit}, (2 + 7 * x) * unit, 0.1 * unit});
    const std::vector<double> c = fit_nonnegative(rows);
    EXPECT_NEAR(c[0] / (2 * unit * unit), 1, 1e-9) << unit;
    EXPECT_NEAR(c[1], 7, 1e-8) << unit;
  }
}

TEST(StudyPlanFit, NoCoefficientIsNegative) {
  // Falls with x: the best that may not fall is the mean, weighted.
  const std::vector<FitRow> rows{{{1, 1}, 3, 1}, {{1, 2}, 2, 1}, {{1, 3}, 1, 0.5}};
  const std::vector<double> c = fit_nonnegative(rows);
  EXPECT_EQ(c[1], 0);
  EXPECT_NEAR(c[0], (3 + 2 + 4 * 1) / 6.0, 1e-12);
  // The least squares of a support are beaten by none of a grid of other coefficients that are allowed.
  const auto chi2 = [&](double a, double b) {
    double sum = 0;
    for (const FitRow& r : rows) sum += std::pow((r.value - a - b * r.term[1]) / r.sigma, 2);
    return sum;
  };
  for (double a = 0; a <= 4; a += 0.125)
    for (double b = 0; b <= 2; b += 0.125) EXPECT_GE(chi2(a, b), chi2(c[0], c[1]) - 1e-9);
}

TEST(StudyPlanFit, TermsThatCannotBeToldApartAreNotInvented) {
  const std::vector<FitRow> rows{{{1, 1, 0}, 4, 1}, {{2, 2, 0}, 8, 1}};
  const std::vector<double> c = fit_nonnegative(rows);
  EXPECT_NEAR(c[0] + c[1], 4, 1e-9);
  EXPECT_EQ(c[2], 0);
  EXPECT_TRUE(c[0] == 0 || c[1] == 0);
}

Posynomial noise_model() {
  return Posynomial({{"rays", {{Knob::accuracy, 1}, {Knob::rays, -1}}}, {"photons", {{Knob::photons, -1}}}});
}

Knobs knobs(double photons, double accuracy, double rays) {
  Knobs k{};
  k.fill(1);
  k[at(Knob::photons)] = photons, k[at(Knob::accuracy)] = accuracy, k[at(Knob::rays)] = rays;
  return k;
}

TEST(StudyPlanModel, PredictsBeyondWhatWasMeasured) {
  Posynomial p = noise_model();
  const auto truth = [](const Knobs& k) {
    return 0.7 * k[at(Knob::accuracy)] / k[at(Knob::rays)] + 30 / k[at(Knob::photons)];
  };
  std::vector<Observation> rows;
  for (const Knobs& k : {knobs(2e4, 0.5, 64), knobs(2e4, 0.5, 256), knobs(16e4, 0.25, 256)})
    rows.push_back({k, truth(k), 0.1 * truth(k)});
  p.fit(rows, 1);
  const Knobs far = knobs(5e6, 0.2, 2048);
  // The mean of draws of rows of 10 %: 200 of them know it to 10 % / sqrt(200) or a few times that.
  EXPECT_NEAR(p.best(far) / truth(far), 1, 0.05);
  EXPECT_NEAR(p.coefficients()[0] / 0.7, 1, 0.05);
  EXPECT_NEAR(p.coefficients()[1] / 30, 1, 0.2);
  EXPECT_EQ(p.misfit(), 1);
  const double before = p.best(far);
  const double drawn = p.value(far, 7);
  p.scale(Posynomial::kBest, 4);
  EXPECT_NEAR(p.best(far) / before, 4, 1e-9);
  EXPECT_EQ(p.value(far, 7), drawn);
}

/// The caches that a pilot makes tell what accuracy mends of indirect light, what photons, and what nothing.
TEST(StudyPlanModel, APilotTellsTheTermsOfIndirectLightApart) {
  PlanModel model = lux_error_model();
  for (const auto& [part, truth] : {std::pair{"indirect light, bias", std::vector{8e-4, 0.03, 2e-4}},
                                    std::pair{"indirect light, noise", std::vector{0.4, 2.0, 12.0}}}) {
    Posynomial& fitted = *model.find(part);
    Posynomial known(fitted.terms());
    known.set(truth);
    std::vector<Observation> rows;
    for (const Knobs& k : pilot_caches(false)) rows.push_back({k, known.best(k), 1e-6});
    fitted.fit(rows, 5);
    ASSERT_EQ(fitted.coefficients().size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
      EXPECT_NEAR(fitted.coefficients()[i] / truth[i], 1, 0.02) << part << ": " << fitted.terms()[i].what;
  }
}

/// Where gloss curves, many rays shared by many samples find a lamp as unevenly as few do, where it is flat
/// they do not. The pictures of a pilot tell which it is, in noise of a quarter.
TEST(StudyPlanModel, APilotTellsLampsInFlatGlossFromThoseInCurvedGloss) {
  PlanTask task;
  task.gloss = true;
  const PlanModel model = image_error_model(task, 0.5);
  const std::vector<Monomial>& terms = model.find("direct light, noise")->terms();
  const auto with_one = [&](const char* what, double coefficient) {
    std::vector<double> truth(terms.size(), 0);
    truth[0] = 0.03;  // shadow rays
    const auto at =
        std::find_if(terms.begin(), terms.end(), [&](const Monomial& m) { return m.what == what; });
    truth.at(static_cast<std::size_t>(at - terms.begin())) = coefficient;
    Posynomial known(terms);
    known.set(truth);
    return known;
  };
  const Posynomial flat = with_one("noise of lamps that gloss rays find", 0.06),
                   curved = with_one("noise of lamps that gloss rays find, curved surfaces", 0.004);
  Knobs fine = pilot_pictures(true).back();
  fine[at(Knob::pixels)] = kPilotPixels;
  fine[at(Knob::pixel_samples)] = 128, fine[at(Knob::light_rays)] = fine[at(Knob::gloss_rays)] = 512;
  // Median over pilots of what is predicted there, over what is true.
  const auto told = [&](const Posynomial& truth) {
    std::vector<double> ratio;
    for (std::uint64_t seed = 1; seed <= 15; ++seed) {
      RandomStream random(seed, Stage::test, 0);
      std::vector<Observation> rows;
      for (Knobs k : pilot_pictures(true)) {
        k[at(Knob::pixels)] = kPilotPixels;
        const double seen = truth.best(k) * std::exp(0.25 * normal(random));
        rows.push_back({k, seen, 0.25 * seen});
      }
      Posynomial fitted(terms);
      fitted.fit_noise(rows, seed);
      ratio.push_back(fitted.best(fine) / truth.best(fine));
    }
    std::nth_element(ratio.begin(), ratio.begin() + 7, ratio.end());
    return ratio[7];
  };
  EXPECT_GT(curved.best(fine), 2 * flat.best(fine));
  EXPECT_NEAR(told(flat), 1, 0.2);
  EXPECT_NEAR(told(curved), 1, 0.2);
}

TEST(StudyPlanModel, IntervalsHoldTheTruthNineTimesInTen) {
  const Knobs far = knobs(1e6, 0.3, 512);
  const auto truth = [](const Knobs& k) {
    return 0.7 * k[at(Knob::accuracy)] / k[at(Knob::rays)] + 100 / k[at(Knob::photons)];
  };
  int inside = 0, trials = 200;
  double width = 0;
  for (int t = 0; t < trials; ++t) {
    RandomStream random(7, Stage::test, static_cast<std::uint64_t>(t));
    std::vector<Observation> rows;
    for (const Knobs& k :
         {knobs(2e4, 0.5, 64), knobs(2e4, 0.5, 256), knobs(16e4, 0.25, 256), knobs(16e4, 0.25, 64)})
      rows.push_back({k, truth(k) * (1 + 0.1 * normal(random)), 0.1 * truth(k)});
    PlanModel model{{{"noise", noise_model()}}};
    model.part[0].second.fit(rows, static_cast<std::uint64_t>(t));
    const Interval i = model.predict(far, 0);
    EXPECT_LE(i.low, i.value);
    EXPECT_LE(i.value, i.high);
    inside += i.low <= truth(far) && truth(far) <= i.high;
    width += (i.high - i.low) / truth(far) / trials;
  }
  // 90 % of 200: 180, deviation 4.2; draws about a value that was itself drawn are a little too wide or
  // narrow.
  EXPECT_GE(inside, 165);
  EXPECT_LT(width, 1);
}

TEST(StudyPlanModel, NoiseThatCameOutLowIsNotBelievedMore) {
  // Mean squares of six normal deviates, whose doubt is told in proportion to what came out.
  constexpr int kTrials = 200, kDeviates = 6;
  double plain = 0, as_noise = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    RandomStream random(trial, Stage::pilot, 0);
    std::vector<Observation> rows;
    for (const double rays : {64, 128, 256, 512}) {
      double squares = 0;
      for (int i = 0; i < kDeviates; ++i) squares += std::pow(normal(random), 2) / kDeviates;
      Observation o;
      o.knobs[at(Knob::rays)] = rays, o.value = squares / rays,
      o.sigma = o.value * std::sqrt(2.0 / kDeviates);
      rows.push_back(o);
    }
    Posynomial p({{"noise", {{Knob::rays, -1}}}});
    p.fit(rows, trial);
    plain += p.coefficients()[0] / kTrials;
    p.fit_noise(rows, trial);
    as_noise += p.coefficients()[0] / kTrials;
  }
  EXPECT_LT(plain, 0.75);  // so there is something to mend
  EXPECT_NEAR(as_noise, 1, 0.12);
}

TEST(StudyPlanModel, ATermThatGoesWithAnotherHasItsDoubt) {
  Posynomial p({{"light", {{Knob::rays, -1}}}});
  p.fit(std::vector<Observation>{{knobs(1, 1, 4), 5, 1}}, 3);
  Posynomial more = p;
  more.extend("light", {"fast part", {{Knob::rays, -2}}}, 1.5);
  more.extend("nothing", {"of nothing", {}}, 1);
  ASSERT_EQ(more.terms().size(), 2u);
  for (const std::size_t guess : {std::size_t{0}, std::size_t{7}, Posynomial::kBest})
    for (const double rays : {1.0, 8.0})
      EXPECT_NEAR(more.value(knobs(1, 1, rays), guess), p.value(knobs(1, 1, rays), guess) * (1 + 1.5 / rays),
                  1e-9);
}

TEST(StudyPlanModel, FewSamplesThatMissMoreOfFinePixelsAreKnown) {
  const auto part = [](double sampled, double pixel_samples) {
    PlanModel model = image_error_model(PlanTask(), 0.5);
    Posynomial& p = *model.find("indirect light, bias");
    std::vector<double> c(p.terms().size(), 0);
    c[1] = 1;
    p.set(c);
    add_missed_detail(model, 0.5, sampled, 16);
    Knobs k = knobs(1, 1, 1);
    k[at(Knob::pixels)] = 16, k[at(Knob::pixel_samples)] = pixel_samples;
    return p.best(k);
  };
  EXPECT_NEAR(part(0.5, 1), 0.25, 1e-12);  // as detail says
  EXPECT_NEAR(part(1, 1), 0.25, 1e-12);    // no less
  EXPECT_NEAR(part(0.25, 1), 0.5, 1e-12);  // 16^-0.25
  EXPECT_NEAR(part(0.25, 4), 0.25 / 4 + 0.25 / 16, 1e-12);
  EXPECT_NEAR(part(-3, 1), 1, 1e-12);  // no more than is seen by the pilot
}

TEST(StudyPlanModel, ATermThatMayBeThereHasAShare) {
  // Two rows that the first term alone fits best, and the second just fits as well within their sigma.
  Posynomial p({{"all", {}}, {"rays", {{Knob::rays, 1}}}});
  p.fit(std::vector<Observation>{{knobs(1, 1, 1), 1, 0.1}, {knobs(1, 1, 11), 0.98, 0.1}}, 3);
  EXPECT_GT(p.coefficients()[1], 1e-3);
  EXPECT_LT(p.coefficients()[1], 2e-2);
}

TEST(StudyPlanModel, DoubtWidensAnInterval) {
  PlanModel model{{{"time", Posynomial(std::vector<Monomial>{{"all", {}}})}}};
  model.part[0].second.set({10});
  Knobs k{};
  EXPECT_EQ(model.predict(k, 0).high, 10);
  EXPECT_NEAR(model.predict(k, 0.1).high, 11.64, 0.01);
  EXPECT_NEAR(model.predict(k, 0.1).low, 8.36, 0.01);
}

TEST(StudyPilot, RecordsFollowAPowerUpToTheirPlaces) {
  const RecordCount few = count_of(0.5, 1000, 0.25, 4000, 1e12);
  EXPECT_NEAR(few.at(0.5), 1000, 1e-3);
  EXPECT_NEAR(few.at(0.25), 4000, 1e-3);
  EXPECT_NEAR(few.at(0.125), 16000, 1e-2);
  const RecordCount many = count_of(0.5, 1000, 0.25, 4000, 10000);
  EXPECT_NEAR(many.at(0.5), 1000, 1e-9);
  EXPECT_NEAR(many.at(0.25), 4000, 1e-6);
  EXPECT_NEAR(many.at(0.125), 8000, 1e-6);  // odds 1/9, 2/3, 4
  EXPECT_NEAR(many.at(1e-4), 10000, 1);
  EXPECT_EQ(count_of(0.5, 0, 0.25, 0, 100).at(0.1), 0);
  const RecordCount even = count_of(0.5, 100, 0.25, 100, 100);  // every sensor has one of its own
  EXPECT_NEAR(even.at(0.1), 100, 1e-9);
}

TEST(StudyPilot, AReferenceTellsMoreWithMoreSamplesAndPlaces) {
  ReferenceCost cost{0.1, 1e-6, 4, 10000};
  EXPECT_NEAR(cost.resolution(100), std::sqrt(2 * 4 / 100.0 / 100.0), 1e-12);
  EXPECT_NEAR(cost.samples(cost.resolution(100)), 100, 1e-9);
  EXPECT_NEAR(cost.seconds(100), 0.1 + 1, 1e-9);
}

TEST(StudyPilot, TablesAreThinnedEvenly) {
  std::string csv = "id,x,y\n";
  for (int i = 0; i < 11; ++i) csv += "\"a, b\"," + std::to_string(i) + ",7\n";
  std::size_t rows = 0;
  EXPECT_EQ(thinned_rows(csv, "t", {"x"}, 3, &rows), "x\n0\n5\n10\n");
  EXPECT_EQ(rows, 11u);
  EXPECT_EQ(thinned_rows(csv, "t", {"y", "x"}, 1), "y,x\n7,0\n");
  EXPECT_EQ(thinned_rows(csv, "t", {"x"}, 100).size(), 2 + 10 * 2 + 3u);
  EXPECT_EQ(thinned_rows("id,x\n", "t", {"x"}, 3, &rows), "x\n");
  EXPECT_EQ(rows, 0u);
}

}  // namespace
}  // namespace phos
