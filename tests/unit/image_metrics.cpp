// Measures of difference, against values worked out by hand.
#include "image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"

namespace phos {
namespace {

Image grey(int width, int height, float value) {
  Image image(width, height);
  image.set_rgb("", std::vector<Rgb>(image.pixels(), Rgb(value)));
  return image;
}

TEST(Metrics, ConstantOffset) {
  const LayerMetrics m = compare_images(grey(20, 10, 11), grey(20, 10, 10), {})[0];
  EXPECT_EQ(m.layer, "beauty");
  EXPECT_EQ(m.unit, "cd/m2");
  EXPECT_EQ(m.pixels, 200u);
  EXPECT_DOUBLE_EQ(m.rmse, 1);
  EXPECT_DOUBLE_EQ(m.relative_rmse, 0.1);
  EXPECT_DOUBLE_EQ(m.bias, 1);
  EXPECT_DOUBLE_EQ(m.relative_bias, 0.1);
  EXPECT_DOUBLE_EQ(m.p99, 1);
  EXPECT_DOUBLE_EQ(m.max, 1);
  EXPECT_DOUBLE_EQ(m.epsilon, 0.1);
  EXPECT_NEAR(m.relative_mse, 1 / (100 + 0.01), 1e-12);
  EXPECT_NEAR(m.mean_relative_error, 1 / 10.1, 1e-12);
  const double step = pu21_encode(11) - pu21_encode(10);
  EXPECT_NEAR(m.visual->psnr_db, 20 * std::log10(256 / step), 1e-3);
}

TEST(Metrics, SignsCancelInBiasOnly) {
  Image image = grey(10, 10, 0);
  for (std::size_t i = 0; i < 100; ++i)
    for (const char* c : {"R", "G", "B"}) image.channel(c)[i] = i % 2 == 0 ? 4.0f : 6.0f;
  const LayerMetrics m = compare_images(image, grey(10, 10, 5), {})[0];
  EXPECT_DOUBLE_EQ(m.bias, 0);
  EXPECT_DOUBLE_EQ(m.rmse, 1);
  EXPECT_NEAR(m.mean[0], 5, 1e-12);
}

/// Two references whose noise is independent: their noise leaves the measure, the image's own error stays.
TEST(Metrics, TwoReferencesCancelTheirNoise) {
  RandomStream random(5, Stage::test, 0);
  Image image = grey(200, 200, 11), references[2] = {grey(200, 200, 10), grey(200, 200, 10)};
  for (Image& r : references)
    for (const char* c : {"R", "G", "B"})
      for (float& v : r.channel(c)) v += 6 * random.uniform() - 3;
  const LayerMetrics m = compare_images(image, references[0], {}, &references[1])[0];
  EXPECT_NEAR(m.rmse, 2, 0.02);  // 1 and the variance 6^2 / 12
  EXPECT_NEAR(*m.converged_rmse, 1, 0.02);
  EXPECT_NEAR(*m.relative_converged_rmse, 0.1, 0.002);
  EXPECT_FALSE(compare_images(image, references[0], {})[0].converged_rmse);
}

TEST(Metrics, PercentileLeavesOutTheWorst) {
  Image image = grey(100, 10, 1), reference = grey(100, 10, 1);
  for (std::size_t i = 0; i < 5; ++i) image.channel("G")[i] = 1001;
  const LayerMetrics m = compare_images(image, reference, {})[0];
  EXPECT_DOUBLE_EQ(m.p99, 0);
  EXPECT_DOUBLE_EQ(m.max, 1000);
  EXPECT_NEAR(m.rmse, std::sqrt(5e6 / 3000), 1e-9);
}

TEST(Metrics, ScaleOfLightDoesNotChangeRelativeMeasures) {
  RandomStream random(4, Stage::test, 0);
  Image a(16, 16), b(16, 16);
  for (const char* c : {"R", "G", "B"})
    for (std::size_t i = 0; i < 256; ++i)
      a.channel(c)[i] = random.uniform(), b.channel(c)[i] = random.uniform();
  const LayerMetrics one = compare_images(a, b, {})[0];
  for (const float s : {0x1p-60f, 0x1p60f}) {
    Image as = a, bs = b;
    for (const char* c : {"R", "G", "B"})
      for (std::size_t i = 0; i < 256; ++i) as.channel(c)[i] *= s, bs.channel(c)[i] *= s;
    const LayerMetrics m = compare_images(as, bs, {})[0];
    EXPECT_NEAR(m.relative_rmse, one.relative_rmse, 1e-9);
    EXPECT_NEAR(m.relative_mse, one.relative_mse, 1e-9 * one.relative_mse);
    EXPECT_NEAR(m.mean_relative_error, one.mean_relative_error, 1e-9);
    EXPECT_NEAR(m.rmse, one.rmse * double{s}, 1e-9 * double{s});
  }
}

TEST(Metrics, BlackReference) {
  const LayerMetrics same = compare_images(grey(4, 4, 0), grey(4, 4, 0), {})[0];
  EXPECT_EQ(same.relative_rmse, 0);
  EXPECT_EQ(same.relative_mse, 0);
  EXPECT_EQ(same.visual->ssim, 1);
  const LayerMetrics lit = compare_images(grey(4, 4, 1), grey(4, 4, 0), {})[0];
  EXPECT_TRUE(std::isinf(lit.relative_rmse) && std::isinf(lit.relative_bias) && std::isinf(lit.relative_mse));
  EXPECT_EQ(lit.rmse, 1);
}

TEST(Metrics, NonFiniteIsCountedAndLeftOut) {
  Image image = grey(10, 10, 1);
  image.channel("G")[3] = NAN;
  image.channel("R")[7] = INFINITY;
  const LayerMetrics m = compare_images(image, grey(10, 10, 1), {})[0];
  EXPECT_EQ(m.non_finite, 2u);
  EXPECT_EQ(m.pixels, 98u);
  EXPECT_EQ(m.rmse, 0);
  EXPECT_TRUE(std::isfinite(m.visual->ssim));
  EXPECT_EQ(compare_images(grey(10, 10, 1), image, {})[0].non_finite, 2u);
  Image none = grey(2, 2, NAN);
  const LayerMetrics empty = compare_images(none, none, {})[0];
  EXPECT_EQ(empty.pixels, 0u);
  EXPECT_EQ(empty.rmse, 0);
}

TEST(Metrics, EmissionMask) {
  Image image = grey(4, 4, 1), reference = grey(4, 4, 1);
  image.channel("R")[5] = 500;
  CompareOptions options;
  options.layers = {"beauty"}, options.ignore_emission = true;
  EXPECT_THROW(compare_images(image, reference, options), Error);
  std::vector<Rgb> emission(16, Rgb(0));
  emission[5] = Rgb(0, 0, 3);
  reference.set_rgb("emission", emission);
  const LayerMetrics m = compare_images(image, reference, options)[0];
  EXPECT_EQ(m.ignored, 1u);
  EXPECT_EQ(m.max, 0);
  // Whichever of them saw the lamp.
  Image second = grey(4, 4, 1);
  second.set_rgb("emission", std::vector<Rgb>(16, Rgb(0)));
  image.set_rgb("emission", std::vector<Rgb>(16, Rgb(0)));
  second.channel("emission.R")[6] = 1, image.channel("emission.B")[7] = 1;
  EXPECT_EQ(compare_images(image, reference, options, &second)[0].ignored, 3u);
  EXPECT_EQ(compare_images(image, reference, options)[0].ignored, 2u);
}

TEST(Metrics, LayersAndMismatches) {
  Image a = grey(4, 4, 1), b = grey(4, 4, 1);
  a.channel("illuminance.Y"), b.channel("illuminance.Y"), a.channel("Z"), b.channel("Z"),
      a.channel("weight.Y");
  const std::vector<LayerMetrics> all = compare_images(a, b, {});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].layer, "beauty");
  EXPECT_EQ(all[1].layer, "Z");
  EXPECT_EQ(all[2].layer, "illuminance");
  EXPECT_EQ(all[2].unit, "lx");
  CompareOptions weight;
  weight.layers = {"weight"};
  for (const auto& attempt : {std::pair{grey(4, 5, 1), CompareOptions{}}, std::pair{b, weight}}) {
    try {
      compare_images(a, attempt.first, attempt.second);
      FAIL();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::mismatch);
    }
  }
}

TEST(Pu21, EncodingOfThePaper) {
  EXPECT_NEAR(pu21_encode(100), 256, 1);          // by design: the range of a usual screen
  EXPECT_NEAR(pu21_encode(10000), 595.39, 0.01);  // the authors' maximum
  EXPECT_NEAR(pu21_encode(0.005), 0, 1e-6);
  EXPECT_EQ(pu21_encode(0), pu21_encode(0.005));
  for (double y = 0.005; y < 9000; y *= 1.1) EXPECT_LT(pu21_encode(y), pu21_encode(1.1 * y));
}

TEST(Pu21, SsimFallsWithNoiseAndIgnoresThreads) {
  RandomStream random(8, Stage::test, 0);
  const int size = 40;
  std::vector<float> b(1600), little(1600), much(1600);
  const std::vector<char> counts(1600, 1);
  for (std::size_t i = 0; i < b.size(); ++i) {
    b[i] = 50 + 40 * std::sin(0.05f * static_cast<float>(i));
    const float noise = random.uniform() - 0.5f;
    little[i] = b[i] * (1 + 0.02f * noise), much[i] = b[i] * (1 + 0.5f * noise);
  }
  const Pu21 same = compare_pu21(b, b, counts, size, size), few = compare_pu21(little, b, counts, size, size);
  set_threads(1);
  const Pu21 lot = compare_pu21(much, b, counts, size, size);
  set_threads(3);
  const Pu21 again = compare_pu21(much, b, counts, size, size);
  set_threads(0);
  EXPECT_TRUE(std::isinf(same.psnr_db));
  EXPECT_NEAR(same.ssim, 1, 1e-6);
  EXPECT_GT(few.ssim, 0.99);
  EXPECT_LT(lot.ssim, few.ssim - 0.01);
  EXPECT_GT(few.psnr_db, lot.psnr_db + 20);
  EXPECT_EQ(lot.ssim, again.ssim);
  EXPECT_EQ(lot.psnr_db, again.psnr_db);
}

TEST(Metrics, SsimOfAnEdgeWindowIsThatOfTheWholeFormula) {
  // Two flat pictures: SSIM is its luminance term alone, everywhere, also where the window is cut.
  const std::vector<float> a(81, 20), b(81, 40);
  const std::vector<char> counts(81, 1);
  const double x = pu21_encode(20), y = pu21_encode(40), c1 = 2.56 * 2.56;
  EXPECT_NEAR(compare_pu21(a, b, counts, 9, 9).ssim, (2 * x * y + c1) / (x * x + y * y + c1), 1e-3);
}

TEST(Metrics, DifferenceImageAndTexts) {
  Image a = grey(2, 2, 3), b = grey(2, 2, 5);
  a.channel("R")[0] = NAN;
  const Image d = difference_image(a, b, {});
  EXPECT_EQ(d.rgb("")[0].x, 0);
  EXPECT_EQ(d.rgb("")[1], Rgb(-2));
  const std::vector<LayerMetrics> all = compare_images(a, b, {});
  const Json j = to_json(all[0]);
  EXPECT_EQ(j.find("non_finite")->as_integer(), 1);
  EXPECT_DOUBLE_EQ(j.find("mean")->find("G")->as_number(), 3);
  EXPECT_NE(to_table(all).find("1 pixels are not finite"), std::string::npos);
}

/// Pixels of 100 cd/m2: off by 30 %, by 30 % within their noise, by 10 %, and dark ones off by less than the
/// mean's hundredth.
TEST(Metrics, OutliersAreFarOffAndBeyondTheNoise) {
  Image image(10, 1), reference(10, 1);
  const float off[10] = {1.3f, 1, 1.3f, 1.1f, 1, 1, 0.6f, 1, 1, 1};
  for (const char* c : {"R", "G", "B"}) {
    for (std::size_t i = 0; i < 10; ++i) {
      reference.channel(c)[i] = i == 9 ? 0.f : 100.f;
      image.channel(c)[i] = i == 9 ? 0.1f : 100 * off[i];
    }
  }
  const auto outliers = [&] { return *compare_images(image, reference, {}).front().outliers; };
  EXPECT_NEAR(outliers(), 0.3, 1e-9);  // the first, the third and the seventh
  for (const char* c : {"stderr.R", "stderr.G", "stderr.B"}) {
    for (float& v : image.channel(c)) v = 1;
    image.channel(c)[2] = 10;
  }
  EXPECT_NEAR(outliers(), 0.2, 1e-9);
}

}  // namespace
}  // namespace phos
