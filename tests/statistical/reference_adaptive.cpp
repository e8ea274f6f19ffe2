// Samples that are shared out by noise: the same mean, and less noise.
#include <gtest/gtest.h>

#include "reference/moments.h"
#include "reference/render.h"
#include "reference/render_options.h"
#include "support/scenes.h"

namespace {

using namespace phos;

constexpr std::size_t kWidth = 24, kHeight = 18;

ReferenceOptions options_of(std::int64_t samples, bool adaptive, std::uint64_t seed) {
  ReferenceOptions options;
  options.width = kWidth, options.height = kHeight;
  options.samples = samples, options.adaptive = adaptive, options.seed = seed;
  return options;
}

/// A floor, and a wall that shines on it: what is close to the wall is bright, and noisy.
class BrightCorner : public ::testing::Test {
 protected:
  Image picture(std::int64_t samples, bool adaptive, std::uint64_t seed) const {
    return render_reference(rays_, lights_, scene_.camera[0], options_of(samples, adaptive, seed)).image;
  }
  /// Scattered light.
  static std::vector<double> values(const Image& image) {
    std::vector<double> v;
    const std::vector<Rgb> all = image.rgb(""), emission = image.rgb("emission");
    for (std::size_t i = 0; i < all.size(); ++i) v.push_back(double(luminance(all[i] - emission[i])));
    return v;
  }
  /// Of each pixel, over seeds.
  std::vector<Moments> over_seeds(std::int64_t samples, bool adaptive, std::uint64_t seeds) const {
    std::vector<Moments> found(kWidth * kHeight);
    const std::uint64_t first = adaptive ? 1000 : 1;  // no paths in common with those of even samples
    for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
      const std::vector<double> v = values(picture(samples, adaptive, seed));
      for (std::size_t i = 0; i < v.size(); ++i) found[i].add(v[i]);
    }
    return found;
  }

  const Scene scene_ = test::rectangle_light_perpendicular().scene;
  const RayScene rays_{scene_};
  const Luminaires lights_{scene_};
};

TEST_F(BrightCorner, IsNoDarkerForSharingAndLessNoisy) {
  constexpr std::uint64_t kSeeds = 200;
  const std::vector<Moments> even = over_seeds(64, false, kSeeds), shared = over_seeds(64, true, kSeeds);
  double chi2 = 0, pixels = 0, even_noise = 0, shared_noise = 0, even_sum = 0, shared_sum = 0, variance = 0;
  for (std::size_t i = 0; i < even.size(); ++i) {
    even_noise += even[i].variance(), shared_noise += shared[i].variance();
    even_sum += even[i].mean(), shared_sum += shared[i].mean();
    const double v = (even[i].variance() + shared[i].variance()) / static_cast<double>(kSeeds);
    if (!(v > 0)) continue;
    variance += v, pixels += 1;
    chi2 += (even[i].mean() - shared[i].mean()) * (even[i].mean() - shared[i].mean()) / v;
  }
  EXPECT_GT(pixels, 0.5 * kWidth * kHeight);
  EXPECT_LT(std::fabs(shared_sum - even_sum), 4 * std::sqrt(variance));
  EXPECT_NEAR(chi2 / pixels, 1, 5 * std::sqrt(2 / pixels));
  EXPECT_LT(shared_noise, 0.6 * even_noise);
}

/// What a picture says of its own noise is so, pixel by pixel, though they have unlike many samples.
TEST_F(BrightCorner, KnowsItsNoise) {
  constexpr std::uint64_t kSeeds = 60;
  const std::vector<Rgb> lamp = picture(256, false, 1).rgb("emission");
  std::vector<Moments> found(kWidth * kHeight);
  std::vector<double> stated(found.size(), 0.0);
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Image image = picture(256, true, seed);
    const std::vector<double> v = values(image);
    const std::vector<Rgb> error = image.rgb("stderr");
    for (std::size_t i = 0; i < error.size(); ++i) {
      found[i].add(v[i]);
      stated[i] += double(luminance(error[i])) * double(luminance(error[i])) / double(kSeeds);
    }
  }
  double said = 0, noise = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (lamp[i] == Rgb(0)) said += stated[i], noise += found[i].variance();
  EXPECT_GT(noise, 0);
  EXPECT_NEAR(said / noise, 1.1, 0.2);  // strata of a pixel make it better than it says
}

TEST_F(BrightCorner, MeansTheSamplesThatAreAskedFor) {
  for (const std::int64_t samples : {1, 5, 16, 100}) {
    const ReferencePicture p =
        render_reference(rays_, lights_, scene_.camera[0], options_of(samples, true, 1));
    EXPECT_EQ(p.samples, samples);
  }
  ReferenceOptions until = options_of(100000, true, 1);
  until.error = 0.02;
  const ReferencePicture shared = render_reference(rays_, lights_, scene_.camera[0], until);
  until.adaptive = false;
  const ReferencePicture even = render_reference(rays_, lights_, scene_.camera[0], until);
  EXPECT_LE(shared.error, 0.02);
  EXPECT_LE(even.error, 0.02);
  EXPECT_LT(static_cast<double>(shared.samples), 0.7 * static_cast<double>(even.samples));
}

}  // namespace
