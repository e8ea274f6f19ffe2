// Stated standard errors are the true ones: in 90 to 98 % of cases the truth lies within two of them, in
// every scene of known light, for each way of estimating it. tests/bench/cache_calibration_table has the
// figures.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "support/calibration.h"

namespace phos::test {
namespace {

constexpr double kLeast = 0.90, kMost = 0.98;

CalibrationOptions small() {
  CalibrationOptions options;
  options.paths = 60'000, options.candidates = 4000, options.rays = 128;
  options.points = 40, options.records = 8;
  return options;
}

class EveryScene : public ::testing::TestWithParam<std::size_t> {};

TEST_P(EveryScene, TwoStandardErrorsHoldTheTruth) {
  const AnalyticScene s = std::move(all_point_scenes()[GetParam()]);
  const CalibratedScene scene(s, small());
  const bool quick = s.scene.light[0].kind == Light::Kind::point || s.name == "emitting environment";
  const std::uint64_t seeds = quick ? 64 : 12;
  CalibrationTable table;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) scene.measure(seed, table);
  for (const auto& [estimator, c] : table) {
    if (c.exact_share() == 1) continue;  // there is no error
