// Coefficients, gradients and standard errors of radiance over many random hemispheres.
#include <gtest/gtest.h>

#include "estimate/radiance_gather.h"
#include "support/gathered.h"
#include "support/radiance_scenes.h"

namespace phos {
namespace {

using Spread = test::Spreads;

constexpr int kOrder = 6;

/// Walls at 0.8 m to 1.2 m, one five times as bright: 36 values and 72 slopes, none of which is off by more
/// than chance (4 standard errors: once in 150 such tests), though the cosine of emitters is bounded.
TEST(Radiance, NoBiasAndAnHonestError) {
  for (const std::string name : {"closed_box_5L", "rect_wall_x1"}) {
    const test::GradientScene scene = test::gradient_scene(name);
    const auto at = [&](const DVec3& p) { return test::coefficients(scene, scene.receiver + p, kOrder); };
    const std::vector<double> truth = at(DVec3(0)), slope_x = test::slope_along(0, 0.01, at),
                              slope_y = test::slope_along(1, 0.01, at);
    RadianceProjector projector(kOrder);
    Spread light, x, y;
    std::vector<double> stated(kOrder), actual(kOrder);
    constexpr int kTimes = 300;
    for (std::uint64_t i = 0; i < kTimes; ++i) {
      RandomStream random(31, Stage::test, i);
      const Hemisphere h = test::seen_over_solid_angle(scene, 16, random);
      const RadianceRecord r = projector.project(h, RadianceGradient::analytic, 0);
      light.add(test::channel(r.light));
      x.add(test::channel(r.gradient_x)), y.add(test::channel(r.gradient_y));
      const std::vector<double> error = test::channel(r.stderr_light);
      for (std::size_t l = 0; l < kOrder; ++l) stated[l] += error[l] * error[l] / kTimes;
    }
    EXPECT_LT(light.worst_z(truth, 1e-5 * test::norm(truth)), 4) << name;
    EXPECT_LT(x.worst_z(slope_x, 2e-3 * test::norm(slope_x)), 4) << name;
    EXPECT_LT(y.worst_z(slope_y, 2e-3 * test::norm(slope_x)), 4) << name;
    // What is stated may be up to double the true variance at edges of light.
    for (std::size_t l = 0; l < kOrder; ++l) {
      for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i)
        actual[l] += light.variance(i) / static_cast<double>(2 * l + 1);
      EXPECT_GT(stated[l] / actual[l], 0.85) << name << ", band " << l;
      EXPECT_LT(stated[l] / actual[l], 2.1) << name << ", band " << l;
    }
  }
}

/// A dark plate before a lamp: the edge of its shadow moves with the plate, which only neighbouring rays
/// tell. The mean over many hemispheres, relative to the truth, by finite differences; edges lie anywhere in
/// their cells, and on the mean of those on their walls.
TEST(Radiance, HybridGradientsSeeOcclusion) {
  const test::GradientScene scene = test::gradient_scene("rect_occluded");
  const auto at = [&](const DVec3& p) { return test::coefficients(scene, scene.receiver + p, kOrder); };
  const std::vector<double> slope_x = test::slope_along(0, 0.01, at),
                            slope_y = test::slope_along(1, 0.01, at);
  RadianceProjector projector(kOrder);
  const auto error = [&](RadianceGradient mode, int rings) {
    Spread x, y;
    for (std::uint64_t i = 0; i < 60; ++i) {
      RandomStream random(33, Stage::test, i);
      const RadianceRecord r = projector.project(test::seen_over_solid_angle(scene, rings, random), mode, 0);
      x.add(test::channel(r.gradient_x)), y.add(test::channel(r.gradient_y));
    }
    std::vector<double> mean_x, mean_y;
    for (std::size_t i = 0; i < slope_x.size(); ++i) mean_x.push_back(x.mean(i)), mean_y.push_back(y.mean(i));
    return std::hypot(test::distance(mean_x, slope_x), test::distance(mean_y, slope_y)) /
           std::hypot(test::norm(slope_x), test::norm(slope_y));
  };
  EXPECT_GT(error(RadianceGradient::analytic, 36), 0.3);
  EXPECT_LT(error(RadianceGradient::hybrid, 16), 0.15);
  EXPECT_LT(error(RadianceGradient::hybrid, 36), 0.08);
}

/// Rays without strata would err by (n^2 |L|^2 - |c|^2) / N (docs/methods.md#j2); strata make it less, and
/// much less for even light, whose error is that of the harmonics within cells alone and is stated exactly.
TEST(Radiance, StrataTakeMostOfTheNoise) {
  const test::GradientScene scene = test::gradient_scene("white_furnace");
  RadianceProjector projector(kOrder);
  Spread light;
  double stated = 0;
  constexpr int kTimes = 300, kRings = 16;
  const double rays = kRings * slices_for(kRings);
  for (std::uint64_t i = 0; i < kTimes; ++i) {
    RandomStream random(32, Stage::test, i);
    const RadianceRecord r =
        projector.project(test::seen_over_solid_angle(scene, kRings, random), RadianceGradient::analytic, 0);
    light.add(test::channel(r.light));
    const std::vector<double> error = test::channel(r.stderr_light);
    for (std::size_t l = 0; l < kOrder; ++l)
      stated += static_cast<double>(2 * l + 1) * error[l] * error[l] / kTimes;
  }
  double actual = 0;
  for (std::size_t i = 0; i < light.sum.size(); ++i) actual += light.variance(i);
  const double unstratified = 2 * std::numbers::pi * (kOrder * kOrder - 1) / rays;
  EXPECT_LT(actual, unstratified / 10);
  EXPECT_NEAR(stated / actual, 1, 0.1);
}

/// Traced rays, with the noise of lamps in them: what one record states is what a hundred differ by.
TEST(Radiance, HonestErrorOfTracedRays) {
  test::Gathered g(test::uniform_box(0.5f).scene);
  const RecordOptions options = test::gather_options(g.scene, Quantity::indirect, 1, 256);
  const RadianceEstimator estimator(g.rays, g.lights, {}, options, kOrder, RadianceGradient::analytic, 1);
  const auto worker = estimator.make_worker();
  Spread light;
  std::vector<double> stated(kOrder);
  constexpr int kTimes = 200;
  for (std::uint64_t i = 0; i < kTimes; ++i) {
    const RadianceRecord r = *estimator.make({{0.5f, 0, 0.4f}, {0, 1, 0}, i}, *worker).radiance;
    light.add(test::channel(r.light));
    const std::vector<double> error = test::channel(r.stderr_light);
    for (std::size_t l = 0; l < kOrder; ++l) stated[l] += error[l] * error[l] / kTimes;
  }
  for (std::size_t l = 0; l < kOrder; ++l) {
    double actual = 0;
    for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i)
      actual += light.variance(i) / static_cast<double>(2 * l + 1);
    EXPECT_GT(stated[l] / actual, 0.8) << "band " << l;
    EXPECT_LT(stated[l] / actual, 2.1) << "band " << l;
  }
}

}  // namespace
}  // namespace phos
