// Pictures for people: tone mapping, false colour, scales and legends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "image/canvas.h"
#include "image/false_colour.h"
#include "image/tone_map.h"

namespace phos {
namespace {

Colour8 pixel(const Picture& p, int x, int y) {
  const std::size_t i =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(p.width) + static_cast<std::size_t>(x));
  return {p.rgb[i], p.rgb[i + 1], p.rgb[i + 2]};
}

double lightness(const Colour8& c) {  // CIE L*
  const auto linear = [](std::uint8_t b) {
    const double s = b / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

TEST(Palette, ViridisRisesEvenlyAndEndsWhereItShould) {
  EXPECT_NEAR(palette_colour(Palette::viridis, 0)[2], 0.329 * 255, 4);
  EXPECT_NEAR(palette_colour(Palette::viridis, 1)[1], 0.906 * 255, 4);
  double before = lightness(palette_colour(Palette::viridis, 0));
  const double mean_step = (lightness(palette_colour(Palette::viridis, 1)) - before) / 20;
  for (int i = 1; i <= 20; ++i) {
    const double now = lightness(palette_colour(Palette::viridis, i / 20.0));
    EXPECT_NEAR(now - before, mean_step, 0.5 * mean_step) << i;
    before = now;
  }
}

TEST(Palette, DifferenceIsWhiteAtZeroAndDarkerAway) {
  for (const double sign : {-1.0, 1.0})
    for (double t = 0; t < 0.95; t += 0.1)
      EXPECT_GT(lightness(difference_colour(sign * t)), lightness(difference_colour(sign * (t + 0.1))));
  EXPECT_GT(difference_colour(0.5)[0], difference_colour(0.5)[2]);
  EXPECT_GT(difference_colour(-0.5)[2], difference_colour(-0.5)[0]);
}

TEST(Scale, RoundNumbers) {
  EXPECT_DOUBLE_EQ(round_up_125(0.0003), 0.0005);
  EXPECT_DOUBLE_EQ(round_up_125(5), 5);
  EXPECT_DOUBLE_EQ(round_up_125(5.1), 10);
  EXPECT_DOUBLE_EQ(round_down_125(5.1), 5);
  EXPECT_DOUBLE_EQ(round_down_125(0.19), 0.1);
}

TEST(Scale, MarksLieOnTheScaleAtAnySizeOfLight) {
  for (double hi = 1e-12; hi < 1e13; hi *= 7)
    for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
      const FalseColourRange range{scale, scale == Scale::linear ? 0 : hi / 3000, hi};
      const std::vector<double> marks = scale_marks(range, 8);
      EXPECT_GE(marks.size(), 2u) << hi;
      EXPECT_LE(marks.size(), 13u) << hi;
      EXPECT_TRUE(std::is_sorted(marks.begin(), marks.end()));
      for (const double m : marks) EXPECT_TRUE(m >= range.lo * 0.999 && m <= hi * 1.001) << m;
    }
}

TEST(Scale, RangeFromValues) {
  std::vector<float> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(static_cast<float>(i));
  values.push_back(NAN);
  values.push_back(INFINITY);
  EXPECT_DOUBLE_EQ(false_colour_range(values, Scale::linear, {}, {}).hi, 1000);
  EXPECT_DOUBLE_EQ(false_colour_range(values, Scale::linear, {}, {}).lo, 0);
  const FalseColourRange log = false_colour_range(values, Scale::logarithmic, {}, {});
  EXPECT_GT(log.lo, 0);
  EXPECT_DOUBLE_EQ(false_colour_range(values, Scale::logarithmic, 1.0, 50.0).hi, 50);
  EXPECT_THROW(false_colour_range(values, Scale::linear, 5.0, 5.0), Error);
  EXPECT_THROW(false_colour_range(values, Scale::logarithmic, 0.0, 5.0), Error);
  const FalseColourRange black = false_colour_range(std::vector<float>(9, 0.0f), Scale::logarithmic, {}, {});
  EXPECT_TRUE(black.lo > 0 && black.lo < black.hi);
}

TEST(FalseColour, PixelsAndLegend) {
  const std::vector<float> values{0, 50, 100, NAN};
  const FalseColourRange range{Scale::linear, 0, 100};
  const Picture p = false_colour(values, 4, 1, range, Palette::viridis, "luminance", "cd/m2");
  EXPECT_EQ(pixel(p, 0, 0), palette_colour(Palette::viridis, 0));
  EXPECT_EQ(pixel(p, 1, 0), palette_colour(Palette::viridis, 0.5));
  EXPECT_EQ(pixel(p, 2, 0), palette_colour(Palette::viridis, 1));
  EXPECT_EQ(pixel(p, 3, 0), kNotFinite);
  EXPECT_GT(p.width, 4 + Canvas::pixels(1, 1, {}).width_of("luminance", 12));
  EXPECT_GT(p.height, 60);
  // The legend's bar holds the palette from high to low.
  int bright = -1, dark = -1;
  for (int y = 0; y < p.height; ++y) {
    const Colour8 c = pixel(p, 14, y);
    if (bright < 0 && c[1] > 220 && c[0] > 220 && c[2] < 80) bright = y;
    if (c[0] > 60 && c[0] < 80 && c[1] < 10) dark = y;
  }
  EXPECT_GE(bright, 0);
  EXPECT_GT(dark, bright);
}

TEST(ToneMap, GreyStaysGreyBlackBlackNanMagenta) {
  std::vector<Rgb> values(64, Rgb(10));
  values[0] = Rgb(0), values[1] = Rgb(NAN, 1, 1), values[2] = Rgb(1e6f);
  for (const ToneOperator op : {ToneOperator::reinhard, ToneOperator::filmic, ToneOperator::linear}) {
    ToneOptions options;
    options.curve = op;
    const ToneMapped m = tone_map(values, 8, 8, options);
    EXPECT_EQ(m.non_finite, 1u);
    EXPECT_EQ(pixel(m.picture, 0, 0), (Colour8{0, 0, 0}));
    EXPECT_EQ(pixel(m.picture, 1, 0), kNotFinite);
    EXPECT_EQ(pixel(m.picture, 2, 0), (Colour8{255, 255, 255}));
    const Colour8 grey = pixel(m.picture, 5, 5);
    EXPECT_EQ(grey[0], grey[1]);
    EXPECT_EQ(grey[1], grey[2]);
  }
}

TEST(ToneMap, DoesNotDependOnTheUnitOfLight) {
  RandomStream random(2, Stage::test, 0);
  std::vector<Rgb> values(256), tiny(256);
  for (std::size_t i = 0; i < 256; ++i) {
    values[i] = Rgb(random.uniform(), random.uniform(), random.uniform()) * std::exp(8 * random.uniform());
    tiny[i] = 0x1p-40f * values[i];
  }
  EXPECT_EQ(tone_map(values, 16, 16, {}).picture.rgb, tone_map(tiny, 16, 16, {}).picture.rgb);
}

TEST(ToneMap, SaturatedColoursKeepTheirHueAndExposureBrightens) {
  std::vector<Rgb> values(100, Rgb(1));
  values[0] = Rgb(50, 0.5f, 0.5f), values[1] = Rgb(100);
  const ToneMapped m = tone_map(values, 10, 10, {});
  const Colour8 red = pixel(m.picture, 0, 0);
  EXPECT_EQ(red[0], 255);
  EXPECT_EQ(red[1], red[2]);
  EXPECT_LT(red[1], 250);
  ToneOptions brighter;
  brighter.exposure_ev = 1;
  EXPECT_GT(pixel(tone_map(values, 10, 10, brighter).picture, 5, 5)[0], pixel(m.picture, 5, 5)[0]);
  ToneOptions white;
  white.curve = ToneOperator::linear, white.white_cd_m2 = 2;
  EXPECT_EQ(pixel(tone_map(values, 10, 10, white).picture, 5, 5), to_srgb(Rgb(0.5f)));
}

TEST(ToneMap, ExtremesGiveNoNan) {
  for (const float v : {0.0f, 1e-38f, 1e-30f, 1e30f, 3e38f}) {
    const ToneMapped m = tone_map(std::vector<Rgb>(4, Rgb(v)), 2, 2, {});
    EXPECT_EQ(m.non_finite, 0u);
    EXPECT_TRUE(std::isfinite(m.key_cd_m2));
    EXPECT_NE(pixel(m.picture, 0, 0), kNotFinite);
  }
}

}  // namespace
}  // namespace phos
