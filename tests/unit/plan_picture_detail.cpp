// How fast what lies within pixels shrinks, told from a pair of noisy pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/random.h"
#include "plan/calibration.h"
#include "plan/pilot/picture_detail.h"

namespace phos {
namespace {

constexpr int kSide = 96;

/// Means over pixels of f on the unit square, with noise of their own.
Image picture(const std::function<double(double, double)>& f, double noise, std::uint64_t seed) {
  constexpr int kSub = 8;
  Image image(kSide, kSide);
  std::vector<Rgb> values;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      double sum = 0;
      for (int j = 0; j < kSub; ++j)
        for (int i = 0; i < kSub; ++i)
          sum += f((x + (i + 0.5) / kSub) / kSide, (y + (j + 0.5) / kSub) / kSide);
      RandomStream random(seed, Stage::test, values.size());
      values.emplace_back(sum / (kSub * kSub) + noise * (random.uniform_double() - 0.5));
    }
  image.set_rgb("", values);
  return image;
}

double power(const std::function<double(double, double)>& f, double noise) {
  return detail_power(picture(f, noise, 1), picture(f, noise, 2));
}

double edge(double x, double y) { return x + 0.37 * y < 0.6 ? 1 : 0; }
/// The same in each of 768 x 768 cells, whatever the pixels.
double grain(double x, double y) {
  const auto cell = [](double u) { return static_cast<std::uint64_t>(u * 768); };
  return RandomStream(3, Stage::test, cell(y) * 768 + cell(x)).uniform_double();
}

TEST(PictureDetail, OfLoneEdgesShrinksAsTheirPixels) {
  EXPECT_NEAR(power(edge, 0), 0.5, 0.08);
  EXPECT_NEAR(power(edge, 0.3), 0.5, 0.1);
}

TEST(PictureDetail, OfSmoothLightShrinksFastest) {
  EXPECT_NEAR(power([](double x, double y) { return x + y * y; }, 0.001), 1, 0.05);
}

TEST(PictureDetail, OfGrainStays) {
  EXPECT_EQ(power(grain, 0), calibration::kLeastDetailPower);
  EXPECT_LT(power([](double x, double y) { return grain(x, y) + 0.02 * edge(x, y); }, 0.1), 0.2);
}

/// A wave along x and along y, about 2, of `samples` points in each pixel.
Image sampled(int side, int samples) {
  Image image(side, side);
  std::vector<Rgb> values;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      double sum = 0;
      for (int i = 0; i < samples; ++i) {
        const double u = (i + 0.5) / samples, v = std::fmod(0.5 + i * 0.6180339887, 1);
        sum += 2 + std::sin(300 * (x + u) / side) * std::sin(300 * (y + v) / side);
      }
      values.emplace_back(sum / samples);
    }
  image.set_rgb("light", values);
  return image;
}

/// Two waves lie in a pixel of the small picture, so that one point of it tells nothing of their mean; in the
/// wide one a quarter of a wave does.
TEST(PictureDetail, SamplesDifferByWhatLiesWithinPixels) {
  const double small = differs_within_pixels(sampled(24, 1), sampled(24, 64), "light"),
               wide = differs_within_pixels(sampled(192, 1), sampled(192, 64), "light");
  EXPECT_NEAR(small, 0.25 / 4, 0.02);  // variance 1/4, mean 2
  EXPECT_LT(wide, small / 3);
  EXPECT_GT(wide, small / 100);
  EXPECT_EQ(differs_within_pixels(sampled(24, 4), sampled(24, 4), "light"), 0);
}

TEST(PictureDetail, OfNothingIsNotKnown) {
  EXPECT_EQ(power([](double, double) { return 1.0; }, 0), calibration::kLeastDetailPower);
}

}  // namespace
}  // namespace phos
