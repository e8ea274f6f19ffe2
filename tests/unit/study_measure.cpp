// Errors against a reference whose noise is taken out: by hand, and of known noise.
#include "study/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "study/measure_lux.h"
#include "support/run.h"

namespace phos {
namespace {

Image grey(int width, const std::vector<float>& values) {
  Image image(width, static_cast<int>(values.size()) / width);
  std::vector<Rgb> rgb;
  for (const float v : values) rgb.emplace_back(v);
  image.set_rgb("", rgb);
  return image;
}

/// Standard normal, by the sum of twelve.
double normal(std::uint64_t seed, int pixel, int which) {
  RandomStream random(seed, Stage::test, static_cast<std::uint64_t>(2 * pixel + which));
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.uniform_double();
  return sum;
}

TEST(StudyMeasure, IsWhatTheHandComputes) {
  // d of the mean reference (1, 2, 3, 4): 1, 0, -1, 2; half differences 0.5, 0, 0, 1.
  const Image image = grey(2, {2, 2, 2, 6}), a = grey(2, {1.5f, 2, 3, 5}), b = grey(2, {0.5f, 2, 3, 3});
  const MeasuredError e = measure_picture(image, a, &b);
  EXPECT_EQ(e.quantity, "beauty");
  EXPECT_EQ(e.unit, "cd/m2");
  EXPECT_EQ(e.places, 4u);
  EXPECT_DOUBLE_EQ(e.magnitude, 2.5);
  EXPECT_DOUBLE_EQ(e.rmse, std::sqrt((6 - 1.25) / 4));
  EXPECT_DOUBLE_EQ(e.relative_rmse, e.rmse / 2.5);
  EXPECT_DOUBLE_EQ(e.bias, 0.5);
  EXPECT_DOUBLE_EQ(e.max, 2);
  EXPECT_DOUBLE_EQ(e.noise.value(), std::sqrt(1.25 / 4) / 2.5);
  // u^2: mean of squares of draws / 3 = (0.0625 + 1) / 12; resolution: 2 sqrt(4 u^2 / 4), rooted.
  EXPECT_DOUBLE_EQ(e.resolution.value(), std::sqrt(2 * std::sqrt(4 * (1.0625 / 12) / 4)) / 2.5);
  EXPECT_FALSE(e.stated);
}

TEST(StudyMeasure, ProductOfDifferencesIsTheSame) {
  const Image image = grey(2, {2, 2, 2, 6}), a = grey(2, {1.5f, 2, 3, 5}), b = grey(2, {0.5f, 2, 3, 3});
  double products = 0;
  for (const double p : {0.5 * 1.5, 0.0, 1.0, 1.0 * 3.0}) products += p;
  EXPECT_DOUBLE_EQ(measure_picture(image, a, &b).rmse, std::sqrt(products / 4));
}

TEST(StudyMeasure, TakesNoiseOutAndSaysWhatItCannotTell) {
  constexpr int kSide = 128;
  constexpr double kError = 0.03, kNoise = 0.2;
  std::vector<float> image, truth, a, b;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double t = 1 + 0.5 * std::sin(0.1 * i);
    truth.push_back(static_cast<float>(t));
    image.push_back(static_cast<float>(t + kError * (i % 2 ? 1 : -1)));
    a.push_back(static_cast<float>(t + kNoise * normal(1, i, 0)));
    b.push_back(static_cast<float>(t + kNoise * normal(1, i, 1)));
  }
  const Image second = grey(kSide, b);
  const MeasuredError e = measure_picture(grey(kSide, image), grey(kSide, a), &second);
  EXPECT_NEAR(e.magnitude, 1, 0.02);
  EXPECT_NEAR(e.noise.value(), kNoise / std::sqrt(2), 0.003);
  // Deviation of the mean square at no error is s^2 / sqrt(n).
  EXPECT_NEAR(e.resolution.value(), std::sqrt(2 * kNoise * kNoise / kSide), 0.001);
  EXPECT_TRUE(e.resolved());
  EXPECT_NEAR(e.relative_rmse, kError, 4 * e.rmse_stderr.value());
  EXPECT_LT(e.rmse_stderr.value(), 0.3 * kError);
  EXPECT_LT(std::fabs(e.relative_bias), 4 * e.bias_stderr.value());
  EXPECT_NEAR(e.bias_stderr.value(), kNoise / std::sqrt(2) / kSide, 0.0002);

  const MeasuredError none = measure_picture(grey(kSide, truth), grey(kSide, a), &second);
  EXPECT_FALSE(none.resolved()) << none.relative_rmse;
}

TEST(StudyMeasure, SpreadOverReferencesIsWhatItSays) {
  constexpr int kSide = 32, kRuns = 200;
  constexpr double kError = 0.05, kNoise = 0.1;
  double sum = 0, squares = 0, said = 0;
  for (int run = 0; run < kRuns; ++run) {
    const auto seed = static_cast<std::uint64_t>(10 + run);
    std::vector<float> image, a, b;
    for (int i = 0; i < kSide * kSide; ++i) {
      image.push_back(static_cast<float>(1 + kError * (i % 2 ? 1 : -1)));
      a.push_back(static_cast<float>(1 + kNoise * normal(seed, i, 0)));
      b.push_back(static_cast<float>(1 + kNoise * normal(seed, i, 1)));
    }
    const Image second = grey(kSide, b);
    const MeasuredError e = measure_picture(grey(kSide, image), grey(kSide, a), &second);
    const double square = e.relative_rmse * e.relative_rmse;
    sum += square, squares += square * square, said += e.rmse_stderr.value() / kRuns;
  }
  const double mean = sum / kRuns, deviation = std::sqrt(squares / kRuns - mean * mean);
  EXPECT_NEAR(mean, kError * kError, 4 * deviation / std::sqrt(kRuns));
  // d rmse = d rmse^2 / (2 rmse); 200 runs know a deviation to 5 %.
  EXPECT_NEAR(said, deviation / (2 * kError), 0.2 * said);
}

TEST(StudyMeasure, BelievesStandardErrors) {
  Image reference = grey(2, {1, 1, 1, 1});
  const std::vector<Rgb> spread(4, Rgb(0.1f));
  reference.set_rgb("stderr", spread);
  Image image = grey(2, {1.5f, 0.5f, 1.5f, 0.5f});
  image.set_rgb("stderr", std::vector<Rgb>{Rgb(0.3f), Rgb(0.3f), Rgb(0.1f), Rgb(0.1f)});
  const MeasuredError e = measure_picture(image, reference);
  EXPECT_NEAR(e.rmse, std::sqrt(0.25 - 0.01), 1e-7);
  EXPECT_NEAR(e.noise.value(), 0.1, 1e-7);
  EXPECT_NEAR(e.stated.value(), std::sqrt(0.05), 1e-7);
  EXPECT_DOUBLE_EQ(e.inside.value(), 0.5);
}

/// 95 % of normal errors, if references say how noisy they are; their difference alone, one draw at each
/// place, is too small in half of all places, and tells less.
TEST(StudyMeasure, WhatLiesWithinIsToldByWhatReferencesState) {
  constexpr int kSide = 100;
  constexpr double kOwn = 0.05, kNoise = 0.1;
  std::vector<float> values[3];
  for (int i = 0; i < kSide * kSide; ++i)
    for (int k = 0; k < 3; ++k)
      values[k].push_back(static_cast<float>(1 + (k == 0 ? kOwn : kNoise) * normal(3, i, k)));
  Image image = grey(kSide, values[0]), a = grey(kSide, values[1]), b = grey(kSide, values[2]);
  image.set_rgb("stderr", std::vector<Rgb>(kSide * kSide, Rgb(static_cast<float>(kOwn))));
  const double by_difference = measure_picture(image, a, &b).inside.value();
  for (Image* reference : {&a, &b})
    reference->set_rgb("stderr", std::vector<Rgb>(kSide * kSide, Rgb(static_cast<float>(kNoise))));
  const MeasuredError e = measure_picture(image, a, &b);
  EXPECT_NEAR(e.inside.value(), 0.9545, 0.01);
  EXPECT_LT(by_difference, 0.91);
  EXPECT_NEAR(e.relative_rmse, kOwn, 4 * e.rmse_stderr.value());  // the rest goes by the difference
}

TEST(StudyMeasure, LampsAreLeftOut) {
  Image reference = grey(2, {1, 1, 1, 100});
  reference.set_rgb("emission", std::vector<Rgb>{Rgb(0), Rgb(0), Rgb(0), Rgb(99)});
  const Image image = grey(2, {1.5f, 1, 1, 50});
  const MeasuredError e = measure_picture(image, reference);
  EXPECT_EQ(e.left_out, 1u);
  EXPECT_EQ(e.places, 3u);
  EXPECT_DOUBLE_EQ(e.rmse, std::sqrt(0.25 / 3));
  EXPECT_FALSE(e.resolution);
  EXPECT_TRUE(e.resolved());
  EXPECT_EQ(measure_picture(image, reference, nullptr, {"beauty", false}).places, 4u);
  // A second reference, or the image, that saw a lamp where the first did not.
  Image second = grey(2, {1, 1, 50, 100}), seen = image;
  second.set_rgb("emission", std::vector<Rgb>{Rgb(0), Rgb(0), Rgb(49), Rgb(99)});
  EXPECT_EQ(measure_picture(image, reference, &second).places, 2u);
  seen.set_rgb("emission", std::vector<Rgb>{Rgb(1), Rgb(0), Rgb(0), Rgb(0)});
  EXPECT_EQ(measure_picture(seen, reference, &second).places, 1u);
}

TEST(StudyMeasure, DoesNotDependOnTheUnit) {
  for (const float scale : {1e-12f, 1e-6f, 1e6f, 1e12f}) {
    const Image image = grey(2, {2 * scale, 2 * scale, 2 * scale, 6 * scale}),
                a = grey(2, {1.5f * scale, 2 * scale, 3 * scale, 5 * scale}),
                b = grey(2, {0.5f * scale, 2 * scale, 3 * scale, 3 * scale});
    const MeasuredError e = measure_picture(image, a, &b);
    EXPECT_NEAR(e.relative_rmse, std::sqrt((6 - 1.25) / 4) / 2.5, 1e-6) << scale;
    EXPECT_NEAR(e.resolution.value(), std::sqrt(2 * std::sqrt(4 * (1.0625 / 12) / 4)) / 2.5, 1e-6) << scale;
  }
  const Image black = grey(2, {0, 0, 0, 0}), white = grey(2, {1, 1, 1, 1});
  EXPECT_EQ(measure_picture(black, black).relative_rmse, 0);
  EXPECT_TRUE(std::isinf(measure_picture(white, black).relative_rmse));
}

TEST(StudyMeasure, RefusesOtherSizesAndLayers) {
  const Image image = grey(2, {1, 1, 1, 1}), other = grey(2, {1, 1});
  EXPECT_THROW(measure_picture(image, other), Error);
  EXPECT_THROW(measure_picture(image, image, &other), Error);
  EXPECT_THROW(measure_picture(image, image, nullptr, {"indirect", true}), Error);
}

TEST(StudyMeasure, TablesOfLux) {
  const std::string folder = test::scratch("study-measure");
  test::spill(folder + "/a.csv",
              "id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx\n"
              "0,1,2,3,0,1,0,110,5,0,0\n1,2,2,3,0,1,0,90,5,0,0\n");
  test::spill(folder + "/r.csv",
              "x,y,z,nx,ny,nz,illuminance_lx,stderr_lx,r_lx,g_lx,b_lx\n"
              "1,2,3,0,1,0,100,1,0,0,0\n2,2,3,0,1,0,100,1,0,0,0\n");
  test::spill(folder + "/elsewhere.csv", "x,y,z,E_lx\n1,2,3,100\n2,2,4,100\n");
  test::spill(folder + "/none.csv", "x,y,z\n1,2,3\n");
  const LuxTable table = read_lux(folder + "/a.csv"), reference = read_lux(folder + "/r.csv");
  const MeasuredError e = measure_lux(table, reference);
  EXPECT_EQ(e.quantity, "lux");
  EXPECT_EQ(e.unit, "lx");
  EXPECT_NEAR(e.rmse, std::sqrt(100 - 1.0), 1e-9);
  EXPECT_NEAR(e.relative_rmse, std::sqrt(99.0) / 100, 1e-12);
  EXPECT_DOUBLE_EQ(e.bias, 0);
  EXPECT_NEAR(e.stated.value(), 0.05, 1e-12);
  EXPECT_DOUBLE_EQ(e.inside.value(), 1);  // 10 <= 2 sqrt(26)
  EXPECT_THROW(measure_lux(table, read_lux(folder + "/elsewhere.csv")), Error);
  EXPECT_THROW(read_lux(folder + "/none.csv"), Error);
}

}  // namespace
}  // namespace phos
