// The chooser: its front is what trying everything finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "plan/choose.h"
#include "support/synthetic_pilot.h"

namespace phos::test {
namespace {

TEST(StudyPlanChoose, TheFrontIsWhatTryingEverythingFinds) {
  const PlanModel time = synthetic_time(), error = synthetic_error(1e-5);
  const RecordCount count{2000, 0.5, 1.5, 1e9};
  KnobGroup photons{{K::photons}, {{1e4, 4e4, 16e4, 64e4}}};
  KnobGroup records{{K::accuracy, K::rays}, {{0.8, 0.4, 0.2}, {16, 64, 256, 1024}}};
  records.derived = {K::records};
  records.derive = [&](Knobs& k) { k[at(K::records)] = count.at(k[at(K::accuracy)]); };
  KnobGroup samples{{K::pixel_samples, K::light_rays}, {{1, 4, 16}, {1, 4, 16, 64}}};
  samples.allowed = [](const Knobs& k) { return k[at(K::light_rays)] >= k[at(K::pixel_samples)]; };
  Knobs fixed{};
  fixed.fill(1);
  fixed[at(K::pixels)] = 30000;
  const std::vector<PlanPoint> front = plan_front({photons, records, samples}, fixed, time, {&error});

  std::vector<std::pair<double, double>> all;
  for (const double n : photons.levels[0])
    for (const double a : records.levels[0])
      for (const double r : records.levels[1])
        for (const double s : samples.levels[0])
          for (const double l : samples.levels[1]) {
            if (l < s) continue;
            Knobs k = fixed;
            k[at(K::photons)] = n, k[at(K::accuracy)] = a, k[at(K::rays)] = r,
            k[at(K::records)] = count.at(a);
            k[at(K::pixel_samples)] = s, k[at(K::light_rays)] = l;
            all.emplace_back(time.best(k), error.best(k));
          }
  ASSERT_GT(front.size(), 10u);
  for (const PlanPoint& p : front) {
    EXPECT_NEAR(p.cost, time.best(p.knobs), 1e-9 * p.cost);
    EXPECT_NEAR(p.error[0], error.best(p.knobs), 1e-9 * p.error[0]);
  }
  for (const auto& [cost, e] : all) {
    EXPECT_TRUE(std::any_of(
        front.begin(), front.end(),
        [&](const PlanPoint& p) { return p.cost <= cost * (1 + 1e-9) && p.error[0] <= e * (1 + 1e-9); }))
        << cost << " " << e;
  }
  EXPECT_TRUE(std::is_sorted(front.begin(), front.end(),
                             [](const PlanPoint& a, const PlanPoint& b) { return a.cost < b.cost; }));
}

TEST(StudyPlanChoose, TwoQuantitiesAtOnce) {
  const PlanModel time = synthetic_time();
  const PlanModel one{{{"a", known({{"rays", {{K::rays, -1}}}}, {1})}}},
      two{{{"b", known({{"photons", {{K::photons, -1}}}}, {1e4})}}};
  KnobGroup photons{{K::photons}, {{1e4, 1e5, 1e6}}}, rays{{K::rays}, {{16, 64, 256}}};
  Knobs fixed{};
  fixed.fill(1);
  const auto front = plan_front({photons, rays}, fixed, time, {&one, &two});
  EXPECT_EQ(front.size(), 9u);  // each buys something that no other does
}

}  // namespace
}  // namespace phos::test
