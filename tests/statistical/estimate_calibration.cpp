// Stated standard errors are the true ones: in 90 to 98 % of cases the truth lies within two of them, in
// every scene of known light, for each way of estimating it. tests/bench/estimate_calibration_table has the
// figures of larger runs.
#include <gtest/gtest.h>

#include "support/calibration.h"

namespace phos::test {
namespace {

struct Limits {
  double least = 0.90, most = 0.98;
};

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// Where more is known of the stated error than that. None is below what chance makes of a few seeds.
Limits limits_of(const std::string& scene, const std::string& estimator) {
  // Rays of radiance records: differences of strata bound their variance from above.
  if (has(estimator, "radiance by rays")) return {0.86, 0.995};
  // In a furnace that keeps 99 % each seed is one trial: all its light rises and falls together.
  if (has(scene, "0.99")) return {0.85, 1};
  // Samples of lamps that are smooth all over are better than any of them tells.
  if (has(scene, "rectangle") || has(scene, "environment"))
    return {has(estimator, "kernel") ? 0 : 0.86, has(estimator, "hull record") ? 0.99 : 1};
  // Two seeds: of twenty it is 90 to 96 %, to half a per cent.
  if (scene == "Sponza") return {has(estimator, "kernel") ? 0 : 0.86, 1};
  // As many shadow rays as a pilot asks for, with a margin.
  if (has(estimator, "sensor")) return {0.90, 1};
  // What disagrees is not all error, where records of wide zones reach far.
  if (has(estimator, "blended")) return {0.88, 0.998};
  if (has(estimator, "record") || has(estimator, "radiance")) return {0.86, 0.99};
  return {};
}

void expect_calibrated(const CalibratedScene& scene, std::uint64_t seeds) {
  CalibrationTable table;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) scene.measure(seed, table);
  Calibration all;
  for (const auto& [estimator, c] : table) {
    if (c.exact_share() == 1) continue;  // there is no error
    const auto [least, most] = limits_of(scene.name(), estimator);
    EXPECT_GE(c.share(), least) << scene.name() << ", " << estimator << ": true over stated " << c.ratio();
    EXPECT_LE(c.share(), most) << scene.name() << ", " << estimator << ": true over stated " << c.ratio();
    if (!has(estimator, "kernel")) all.add(c);
    ::testing::Test::RecordProperty(estimator, std::to_string(c.share()));
  }
  EXPECT_GE(all.share(), 0.88) << scene.name();
  EXPECT_LE(all.share(), 0.995) << scene.name();
}

class EveryScene : public ::testing::TestWithParam<std::size_t> {};

TEST_P(EveryScene, TwoStandardErrorsHoldTheTruth) {
  const AnalyticScene s = std::move(all_point_scenes()[GetParam()]);
  // Where each seed is one trial, or nearly so, they are many; one trial, of what is cheap.
  const bool common = s.name == "furnace" && s.scene.material[0].kd.x > 0.95f;
  CalibrationOptions options = CalibrationOptions::small();
  options.radiance = !common;
  const bool quick = s.scene.light[0].kind == Light::Kind::point || s.name == "emitting environment";
  expect_calibrated({known_light(s), options}, quick ? 64 : s.name == "furnace" ? 24 : 10);
}

INSTANTIATE_TEST_SUITE_P(All, EveryScene, ::testing::Range<std::size_t>(0, 10));

/// Without that even places on lamps all around are told of, the error stated is half again the true one, and
/// 99.6 % lie within two.
TEST(Gather, StatesTheErrorThatEvenPlacesOnLampsLeave) {
  const AnalyticScene scene = furnace(0.1f);
  const KnownLight known = known_light(scene);
  const RayScene rays(known.scene);
  const Luminaires lights(known.scene);
  RecordOptions options;
  options.estimate = Estimate::gather, options.paths = Quantity::indirect, options.gather_bounces = 1;
  options.resolve(known.scene.bounds.diagonal_m() / 4);
  for (const std::int64_t n : {64, 128, 256}) {
    options.rays = n;
    Calibration found;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
      const GatherEstimator gather(rays, lights, {}, options, seed);
      const auto worker = gather.make_worker();
      const KnownPoints seen = known.points(rays, seed, 100);
      for (std::size_t i = 0; i < seen.at.size(); ++i) {
        const IrradianceRecord r = gather.make({seen.at[i].position, seen.at[i].normal, i}, *worker).record;
        found.add(double(r.irradiance.y), double(r.stderr_lx.y), 0.1 * seen.direct[i]);
      }
    }
    EXPECT_GE(found.share(), 0.90) << n << " rays";
    EXPECT_LE(found.share(), 0.99) << n << " rays";
    EXPECT_NEAR(found.ratio(), 0.95, 0.2) << n << " rays";
  }
}

TEST(RealScene, TwoStandardErrorsHoldTheTruth) {
  std::optional<KnownLight> known = sponza();
  if (!known) GTEST_SKIP() << "the scene collection is not beside the project";
  expect_calibrated({std::move(*known), CalibrationOptions::small_of_real_scene()}, 2);
}

}  // namespace
}  // namespace phos::test
