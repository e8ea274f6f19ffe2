// Flicker of differences whose high frequencies are known.
//
// h_t = d_t - (d_{t-1} + d_{t+1}) / 2 takes d = a cos(w t + p) to (1 - cos w) d: nothing where d is slow, 2 d
// at the Nyquist frequency w = pi. Of white noise of variance s^2 the variance of h is s^2 (1 + 1/4 + 1/4),
// and 2/3 of that is s^2.
#include "image/flicker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.h"
#include "core/random.h"

namespace phos {
namespace {

constexpr int kSide = 64;

/// A grey picture of value(pixel).
Image picture(const std::function<double(std::size_t)>& value) {
  Image image(kSide, kSide);
  std::vector<Rgb> v(image.pixels());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = Rgb(static_cast<float>(value(i)));
  image.set_rgb("", v);
  return image;
}

/// Noise of standard deviation 1 that is another in every pixel, frame and stream.
double noise(std::size_t pixel, int frame, std::uint64_t stream) {
  RandomStream random(stream, Stage::test, static_cast<std::uint64_t>(frame) * 100000 + pixel);
  return std::sqrt(12.0) * (random.uniform() - 0.5);
}

FlickerMetrics measure(int frames, const std::function<double(std::size_t, int)>& image,
                       const std::function<double(std::size_t, int)>& reference) {
  FlickerMeter meter({});
  for (int t = 0; t < frames; ++t)
    meter.add(t, picture([&](std::size_t i) { return image(i, t); }),
              picture([&](std::size_t i) { return reference(i, t); }));
  EXPECT_EQ(meter.metrics().size(), 1u);
  return meter.metrics()[0];
}

TEST(Flicker, WhiteNoiseCountsAsItsStandardDeviation) {
  const FlickerMetrics m = measure(
      20, [](std::size_t i, int t) { return 100 + 3 * noise(i, t, 1); },
      [](std::size_t, int) { return 100; });
  EXPECT_NEAR(m.flicker, 3, 0.03);  // 4096 x 18 values
  EXPECT_NEAR(m.relative_flicker, 0.03, 0.0003);
  EXPECT_NEAR(m.rmse, 3, 0.03);
  EXPECT_EQ(m.pixels, 20u * kSide * kSide);
}

TEST(Flicker, AnErrorThatStaysOrDriftsEvenlyIsNone) {
  // Binary fractions: floats hold them.
  const FlickerMetrics m = measure(
      9, [](std::size_t i, int t) { return 64 + 8 * std::sin(0.1 * static_cast<double>(i)) + 0.25 * t; },
      [](std::size_t i, int) { return 64 + 8 * std::sin(0.1 * static_cast<double>(i)); });
  EXPECT_NEAR(m.flicker, 0, 1e-5);
  EXPECT_NEAR(m.bias, 1, 1e-5);
  EXPECT_NEAR(m.rmse, std::sqrt(204.0 / 9) / 4, 1e-5);  // 0 + 1 + 4 ... + 64 = 204
}

TEST(Flicker, MovingLightInBothIsNone) {
  const auto moving = [](std::size_t i, int t) {
    return 10 + 9 * std::cos(0.3 * static_cast<double>(i) + 2.0 * t);
  };
  EXPECT_EQ(measure(7, moving, moving).flicker, 0);
}

TEST(Flicker, WavesByTheirFrequency) {
  constexpr int kFrames = 2 + 120;  // whole periods of every wave below in between
  for (const double per_120 : {1.0, 5.0, 20.0, 40.0, 60.0}) {
    const double w = 2 * std::numbers::pi * per_120 / 120;
    const FlickerMetrics m = measure(
        kFrames, [&](std::size_t, int t) { return 50 + 4 * std::cos(w * t); },
        [](std::size_t, int) { return 50; });
    const double rms = per_120 == 60 ? 4 : 4 / std::sqrt(2.0);
    const double expected = std::sqrt(2.0 / 3) * (1 - std::cos(w)) * rms;
    EXPECT_NEAR(m.flicker, expected, 1e-5 + 1e-4 * expected) << per_120;
  }
}

TEST(Flicker, NoiseOfTwoReferencesAveragesOut) {
  FlickerMeter meter({});
  for (int t = 0; t < 40; ++t) {
    const Image image = picture([&](std::size_t i) { return 100 + 1 * noise(i, t, 1); }),
                first = picture([&](std::size_t i) { return 100 + 2 * noise(i, t, 2); }),
                second = picture([&](std::size_t i) { return 100 + 2 * noise(i, t, 3); });
    meter.add(t, image, first, &second);
  }
  const FlickerMetrics m = meter.metrics()[0];
  EXPECT_NEAR(m.flicker, std::sqrt(5.0), 0.03);
  EXPECT_NEAR(*m.converged_flicker, 1, 0.04);
  EXPECT_NEAR(*m.relative_converged_flicker, 0.01, 0.0004);
  EXPECT_NEAR(*m.converged_rmse, 1, 0.04);
}

TEST(Flicker, OfEachPixelAndEachFrame) {
  FlickerMeter meter({});
  for (int t = 0; t < 6; ++t)
    meter.add(10 + t, picture([&](std::size_t i) { return i == 5 ? 8 + (t % 2) : 8; }),
              picture([](std::size_t) { return 8; }));
  const double at_pixel = std::sqrt(2.0 / 3);  // |h| = 1 at every frame
  const Image each = meter.picture();
  EXPECT_NEAR(each.channel("Y")[5], at_pixel, 1e-6);
  EXPECT_EQ(each.channel("Y")[4], 0);
  EXPECT_NEAR(meter.metrics()[0].flicker, at_pixel / kSide, 1e-6);
  ASSERT_EQ(meter.frames().size(), 6u);
  EXPECT_EQ(meter.frames()[2].frame, 12);
  EXPECT_NEAR(meter.frames()[2].flicker, at_pixel / kSide, 1e-6);
  EXPECT_TRUE(std::isnan(meter.frames()[0].flicker));
  EXPECT_TRUE(std::isnan(meter.frames()[5].flicker));
  EXPECT_NEAR(meter.frames()[1].rmse, 1.0 / kSide, 1e-9);
  EXPECT_EQ(meter.frames()[2].rmse, 0);
  const std::string csv = to_csv(meter.frames());
  EXPECT_NE(csv.find("\n10,beauty,8,0,0,0,0,,\n"), std::string::npos) << csv;
}

/// Pixels that count at only some frames: h is there only where three frames in a row have it.
TEST(Flicker, WhatIsLeftOutIsNotMeasured) {
  FlickerMeter meter({.layers = {}, .ignore_emission = true});
  for (int t = 0; t < 7; ++t) {
    Image image = picture([&](std::size_t i) { return i == 0 ? 1000.0 * (t % 2) : 5; });
    Image reference = picture([](std::size_t) { return 5; });
    image.set_rgb("emission", std::vector<Rgb>(image.pixels(), Rgb(0)));
    reference.set_rgb("emission", std::vector<Rgb>(image.pixels(), Rgb(0)));
    if (t == 1 || t == 4) reference.channel("emission.G")[0] = 1;  // no three in a row without it
    if (t == 3) image.channel("R")[9] = std::numeric_limits<float>::infinity();
    meter.add(t, image, reference);
  }
  const FlickerMetrics m = meter.metrics()[0];
  EXPECT_EQ(m.layer, "beauty");
  EXPECT_EQ(m.flicker, 0);
  EXPECT_EQ(m.ignored, 2u);
  EXPECT_EQ(m.non_finite, 1u);
  EXPECT_EQ(m.pixels, 7u * kSide * kSide - 3);
  EXPECT_TRUE(std::isfinite(m.rmse));
}

TEST(Flicker, UnitsOfAnySize) {
  for (const double unit : {1e-30, 1e-12, 1e12, 1e30}) {
    const FlickerMetrics m = measure(
        9, [&](std::size_t i, int t) { return unit * (2 + noise(i, t, 4)); },
        [&](std::size_t, int) { return 2 * unit; });
    EXPECT_NEAR(m.relative_flicker, 0.5, 0.01) << unit;
    EXPECT_NEAR(m.flicker / unit, 1, 0.02) << unit;
  }
  EXPECT_EQ(measure(
                5, [](std::size_t, int) { return 0; }, [](std::size_t, int) { return 0; })
                .relative_flicker,
            0);
  const FlickerMetrics dark = measure(
      5, [](std::size_t, int t) { return t % 2; }, [](std::size_t, int) { return 0; });
  EXPECT_TRUE(std::isinf(dark.relative_flicker));
}

TEST(Flicker, FramesMustBeOfOneKind) {
  const Image one = picture([](std::size_t) { return 1; });
  Image small(2, 2), more = one, normals(kSide, kSide);
  small.set_rgb("", std::vector<Rgb>(4));
  more.set_rgb("indirect", std::vector<Rgb>(more.pixels()));
  for (const char* c : {"normal.X", "normal.Y", "normal.Z"}) normals.channel(c);
  const auto code = [](const CompareOptions& options, const Image& first, const Image& second) {
    try {
      FlickerMeter meter(options);
      meter.add(0, first, first);
      meter.add(1, second, first);
    } catch (const Error& e) {
      return e.code();
    }
    return ExitCode::done;
  };
  EXPECT_EQ(code({}, one, small), ExitCode::mismatch);
  EXPECT_EQ(code({}, more, one), ExitCode::mismatch);
  EXPECT_EQ(code({}, one, more), ExitCode::done) << "layers that nobody asked for";
  EXPECT_EQ(code({.layers = {"indirect"}, .ignore_emission = false}, one, one), ExitCode::mismatch);
  EXPECT_EQ(code({}, normals, normals), ExitCode::mismatch);
  EXPECT_EQ(code({.layers = {"normal"}, .ignore_emission = false}, normals, normals), ExitCode::bad_input);
}

}  // namespace
}  // namespace phos
