// Errors that pictures state are differences of nearly equal sums: what is left where nothing varies.
#include <gtest/gtest.h>

#include "core/random.h"
#include "record/blend.h"
#include "splat/picture/layers.h"
#include "support/rounding.h"

namespace phos::test {
namespace {

/// Noise is a millionth of the light, and said to be that.
TEST(Rounding, ErrorsOfPixels) {
  const std::vector<std::string> wanted{"stderr"};
  Rounding error;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    RandomStream random(2, Stage::test, trial);
    const float light = std::pow(10.f, 20 * random.uniform() - 10);
    const auto n = static_cast<std::uint16_t>(2 + trial % 1000);
    Layers layers(1, 1, LayerSet(wanted), n, 2);
    long double sum = 0, squares = 0;
    for (int s = 0; s < n; ++s) {
      PixelSample sample;
      const float value = light * (1 + 1e-4f * (random.uniform() - 0.5f));
      sample.noisy = Rgb(value);
      layers.add(0, sample);
      sum += static_cast<long double>(value),
          squares += static_cast<long double>(value) * static_cast<long double>(value);
    }
    const long double exact = std::sqrt(std::max(0.0L, squares / n - sum / n * (sum / n)) / (n - 1));
    const Image image = layers.image(std::vector<std::uint16_t>{n});
    error.see(static_cast<double>(image.channel("stderr.R")[0]), exact, static_cast<long double>(light));
  }
  error.expect("the error of a pixel, relative to its light", "samples", 2, 1000, 1e-7);
}

/// Records that agree leave nothing but their own error.
TEST(Rounding, ErrorsOfMeansOfRecords) {
  Rounding error;
  for (std::uint64_t trial = 0; trial < 4000; ++trial) {
    RandomStream random(3, Stage::test, trial);
    const Rgb value = std::pow(10.f, 20 * random.uniform() - 10) * Rgb(1, random.uniform(), 0.3f);
    BlendSums sums;
    float weight = 0;
    Rgb light(0);
    for (std::uint64_t i = 0; i < 1 + trial % 100; ++i) {
      const float w = random.uniform();
      sums.add(w, 0, static_cast<double>(luminance(value))), weight += w, light += w * value;
    }
    const Rgb mean = light / weight;
    const Rgb found = blended_error(sums, weight, mean, Rgb(0), static_cast<double>(luminance(mean)));
    error.see(static_cast<double>(found.x), 0, static_cast<long double>(value.x));
  }
  error.expect("the error of a mean of records, relative to its light", "records", 1, 100, 1e-3);
}

}  // namespace
}  // namespace phos::test
