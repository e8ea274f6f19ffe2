// The stated standard error is the error: calibration over many independent estimates.
#include <gtest/gtest.h>

#include "reference/moments.h"
#include "reference/point_irradiance.h"
#include "reference/render.h"
#include "reference/render_options.h"
#include "support/scenes.h"

namespace {

using namespace phos;

/// z = (estimate - truth) / stated error over `repeats` seeds: |z| < 2 in 95.4 % of normal draws. The share
/// over 400 has a deviation of 1.05 %, so 90-98 % is wide; the mean of z must vanish, its variance be 1.
void expect_calibrated(const test::AnalyticScene& s, std::int64_t samples) {
  constexpr int kRepeats = 400;
  const RayScene rays(s.scene);
  const Luminaires luminaires(s.scene);
  const test::Check& at = s.checks[1];
  Moments z;
  double squares = 0;
  int within = 0;
  for (int i = 0; i < kRepeats; ++i) {
    const PointIrradiance e = estimate_irradiance(rays, luminaires, at.position, at.normal, samples, -1,
                                                  100 + static_cast<std::uint64_t>(i));
    ASSERT_GT(e.illuminance_stderr_lx, 0);
    const double deviation = (e.illuminance_lx - at.irradiance_lx) / e.illuminance_stderr_lx;
    z.add(deviation), squares += deviation * deviation;
    within += std::abs(deviation) < 2;
  }
  EXPECT_GE(within, 0.90 * kRepeats) << s.name;
  EXPECT_LE(within, 0.98 * kRepeats) << s.name;
  EXPECT_LT(std::abs(z.mean()), 4 / std::sqrt(kRepeats)) << s.name;
  EXPECT_NEAR(squares / kRepeats, 1, 4 * std::sqrt(2.0 / kRepeats)) << s.name;
}

TEST(ReferenceError, CalibratedOnRectangle) { expect_calibrated(test::rectangle_light_parallel(), 1000); }
TEST(ReferenceError, CalibratedInFurnace) { expect_calibrated(test::furnace(0.5f), 1000); }
TEST(ReferenceError, CalibratedInEnvironment) { expect_calibrated(test::emitting_environment(), 1000); }

/// The error falls with the root of the number of samples.
TEST(ReferenceError, FallsWithTheRoot) {
  const test::AnalyticScene s = test::furnace(0.5f);
  const RayScene rays(s.scene);
  const Luminaires luminaires(s.scene);
  const auto error = [&](std::int64_t samples) {
    return estimate_irradiance(rays, luminaires, s.checks[0].position, s.checks[0].normal, samples)
        .illuminance_stderr_lx;
  };
  EXPECT_NEAR(error(64000) / error(4000), 0.25, 0.03);
}

/// The two ways to sample a light, MIS-weighted, and the choice of one light of many, do not change the mean:
/// the same rectangle cut into strips, each its own luminaire.
TEST(ReferenceError, ManyLightsOneAnswer) {
  const test::AnalyticScene whole = test::rectangle_light_parallel(2, 3, 1.5f, 1000, 0);
  for (const int strips : {1, 3, 30}) {
    Scene scene;
    test::begin_instance(scene, "floor", test::add_lambert(scene, "black", 0));
    test::add_quad(scene, {-6, 0, -6}, {0, 0, 15}, {14, 0, 0});
    const std::uint32_t glow = test::add_lambert(scene, "light", 0, 1000);
    for (int i = 0; i < strips; ++i) {
      const float z0 = 3.f * static_cast<float>(i) / static_cast<float>(strips);
      test::begin_instance(scene, "strip " + std::to_string(i), glow);
      test::add_quad(scene, {0, 1.5f, z0}, {2, 0, 0}, {0, 0, 3.f / static_cast<float>(strips)});
    }
    finalize(scene);
    ASSERT_EQ(scene.light.size(), static_cast<std::size_t>(strips));
    const RayScene rays(scene);
    const Luminaires luminaires(scene);
    for (const test::Check& at : whole.checks) {
      const PointIrradiance e = estimate_irradiance(rays, luminaires, at.position, at.normal, 20000, -1, 5);
      EXPECT_NEAR(e.illuminance_lx, at.irradiance_lx, 4 * e.illuminance_stderr_lx) << strips << " strips";
      EXPECT_LT(e.illuminance_stderr_lx, 0.02 * at.irradiance_lx) << strips << " strips";
    }
  }
}

/// --error: the picture ends with the error that was asked for, and not long after.
TEST(ReferenceError, PictureStopsWhenReached) {
  const Scene scene = test::cornell();
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  ReferenceOptions options;
  options.width = options.height = 24, options.samples = 100000, options.error = 0.05;
  const ReferencePicture picture = render_reference(rays, luminaires, scene.camera[0], options);
  EXPECT_LE(picture.error, 0.05);
  EXPECT_GT(picture.error, 0.035);
  EXPECT_LT(picture.samples, 2000);
  options.samples = 32;
  const ReferencePicture cut = render_reference(rays, luminaires, scene.camera[0], options);
  EXPECT_EQ(cut.samples, 32);
  EXPECT_GT(cut.error, 0.05);
}

/// Two seeds differ by what their standard errors say, in the beauty and in the indirect layer.
TEST(ReferenceError, PicturesOfTwoSeedsDifferByTheirErrors) {
  const Scene scene = test::cornell();
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  ReferenceOptions options;
  options.width = options.height = 32, options.samples = 256;
  Image image[2];
  for (int k = 0; k < 2; ++k) {
    options.seed = static_cast<std::uint64_t>(k);
    image[k] = render_reference(rays, luminaires, scene.camera[0], options).image;
  }
  for (const auto& [layer, error] : {std::pair{"", "stderr"}, std::pair{"indirect", "indirect_stderr"}}) {
    const auto a = image[0].rgb(layer), b = image[1].rgb(layer), ea = image[0].rgb(error),
               eb = image[1].rgb(error);
    const auto glow = image[0].rgb("emission");
    double z2 = 0;
    int n = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double variance = ea[i].y * ea[i].y + eb[i].y * eb[i].y;
      if (variance == 0 || glow[i].y > 0) continue;  // edges of the lamp: not normal, and stratified
      const double difference = a[i].y - b[i].y;
      z2 += difference * difference / variance, ++n;
    }
    ASSERT_GT(n, 800);
    EXPECT_NEAR(z2 / n, 1, 0.25) << layer;  // heavier tails than normal: 5 deviations of chi-square
  }
}

}  // namespace
