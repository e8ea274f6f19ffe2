// Functions on discs: which pixel has which colour.
#include <gtest/gtest.h>

#include <cmath>

#include "image/plot/disc_plot.h"

namespace phos::test {
namespace {

/// A disc of 16 pixels with its corner at (10, 23): a gap of 10 pixels, and 13 for its title.
constexpr int kLeft = 10, kTop = 23;

Colour8 at(const Picture& picture, int x, int y) {
  const auto i = 3 * static_cast<std::size_t>(y * picture.width + x);
  return {picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]};
}

DiscPlot plot(std::function<double(double, double)> value) {
  DiscPlot p;
  p.rows = {{{"f", std::move(value)}}};
  p.title = "f", p.diameter = 16;
  return p;
}

TEST(DiscPlot, ColoursOfValuesAtPixels) {
  // The middles of pixels (8, 8) and (12, 3) of the disc are (1/16, -1/16) and (9/16, 9/16).
  DiscPlot p = plot([](double x, double y) { return 10 + x + 2 * y; });
  p.lo = 8, p.hi = 12;
  const Picture picture = disc_plot_picture(p);
  EXPECT_EQ(at(picture, kLeft + 8, kTop + 8), palette_colour(Palette::viridis, (2 - 1 / 16.0) / 4));
  EXPECT_EQ(at(picture, kLeft + 12, kTop + 3), palette_colour(Palette::viridis, (2 + 27 / 16.0) / 4));
  const Colour8 ground{32, 32, 36};
  EXPECT_EQ(at(picture, kLeft, kTop), ground) << "a corner of the square lies beyond the disc";
  EXPECT_EQ(at(picture, kLeft + 15, kTop + 15), ground);
}

TEST(DiscPlot, SignedValuesAndPlacesWithout) {
  DiscPlot p = plot([](double x, double y) { return y > 0 ? NAN : x; });
  p.about_zero = true, p.hi = 0.5, p.absent = "none";
  const Picture picture = disc_plot_picture(p);
  EXPECT_EQ(at(picture, kLeft + 8, kTop + 3), kAbsent);
  EXPECT_EQ(at(picture, kLeft + 9, kTop + 10), difference_colour((3 / 16.0) / 0.5));
  EXPECT_EQ(at(picture, kLeft + 2, kTop + 10), difference_colour(-1)) << "-11/16 is clamped";
}

TEST(DiscPlot, RowsAreCentred) {
  DiscPlot p = plot([](double, double) { return 1; });
  const auto one = p.rows[0][0];
  p.rows = {{one}, {one, one, one}};
  const Picture picture = disc_plot_picture(p);
  const Colour8 full = palette_colour(Palette::viridis, 1), ground{32, 32, 36};
  // Three discs of 26 pixels with their gaps; a row is 39 high.
  EXPECT_EQ(at(picture, kLeft + 8, kTop + 8), ground);
  EXPECT_EQ(at(picture, kLeft + 26 + 8, kTop + 8), full);
  for (const int i : {0, 1, 2}) EXPECT_EQ(at(picture, kLeft + 26 * i + 8, kTop + 39 + 8), full) << i;
}

}  // namespace
}  // namespace phos::test
