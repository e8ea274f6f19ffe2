// Drawing: where words and lines land, what fits, the same bytes twice.
#include "image/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace phos {
namespace {

constexpr Colour8 kWhite{255, 255, 255}, kBlack{0, 0, 0};

/// The box about all that is not white, pixels; right and bottom are beyond it.
struct Inked {
  int left = 1 << 20, top = 1 << 20, right = 0, bottom = 0;
  int width() const { return right - left; }
  int height() const { return bottom - top; }
};
Inked inked(const Picture& p) {
  Inked box;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      const auto at = p.rgb.begin() + std::ptrdiff_t{3} * (std::ptrdiff_t{y} * p.width + x);
      if (std::all_of(at, at + 3, [](std::uint8_t v) { return v > 230; })) continue;
      box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1),
             std::max(box.bottom, y + 1)};
    }
  return box;
}

Picture written(const std::string& words, const Lettering& l, int size = 200) {
  Canvas canvas = Canvas::pixels(size, size, kWhite);
  canvas.write({size / 2.0, size / 2.0}, words, l);
  return canvas.finish_picture();
}

TEST(Canvas, EveryCharacterOfALegendIsDrawn) {
  std::vector<std::string> all{"\xc2\xb2", "\xc2\xb0"};
  for (char c = '!'; c <= '~'; ++c) all.emplace_back(1, c);
  std::vector<std::vector<std::uint8_t>> seen;
  for (const std::string& c : all) {
    const Picture p = written(c, {.colour = kBlack, .size = 12}, 30);
    EXPECT_GT(inked(p).width(), 0) << c;
    EXPECT_EQ(std::find(seen.begin(), seen.end(), p.rgb), seen.end()) << c << " looks like another";
    seen.push_back(p.rgb);
  }
}

TEST(Canvas, WordsStandWhereTheirAlignmentSays) {
  const Lettering plain{.colour = kBlack, .size = 20};
  const double width = Canvas::pixels(1, 1, kWhite).width_of("H088H", 20);
  EXPECT_GT(width, 60);
  EXPECT_LT(width, 80);
  Lettering l = plain;
  const Inked left = inked(written("H088H", l));
  l.align = Align::middle;
  const Inked middle = inked(written("H088H", l));
  l.align = Align::right;
  const Inked right = inked(written("H088H", l));
  EXPECT_NEAR(left.left, 100, 4);
  EXPECT_NEAR(left.right, 100 + width, 4);
  EXPECT_NEAR(middle.left, 100 - width / 2, 4);
  EXPECT_NEAR(right.right, 100, 4);
  // The middle of figures is at the place, and they are 0.73 of the font's size high.
  EXPECT_NEAR((left.top + left.bottom) / 2.0, 100, 1);
  EXPECT_NEAR(left.height(), 0.73 * 20, 2);
  l.align = Align::middle, l.upwards = true;
  const Inked up = inked(written("H088H", l));
  EXPECT_NEAR(up.height(), middle.width(), 1);
  EXPECT_NEAR(up.width(), middle.height(), 1);
  // Read from below: the dot of "H." is at the top.
  const Picture dot = written("H.", {.colour = kBlack, .size = 40, .align = Align::middle, .upwards = true});
  const Picture flat = written("H.", {.colour = kBlack, .size = 40, .align = Align::middle});
  EXPECT_NEAR(inked(dot).top, 200 - inked(flat).right, 2);
}

TEST(Canvas, AHaloKeepsWordsApartFromTheGround) {
  Canvas canvas = Canvas::over(make_picture(60, 40, kBlack));
  canvas.write({10, 20}, "50", {.colour = kBlack, .size = 20, .halo = kWhite});
  const Picture p = canvas.finish_picture();
  EXPECT_GT(std::count(p.rgb.begin(), p.rgb.end(), 255), 300);
  EXPECT_EQ(p.rgb[0], 0);
}

TEST(Canvas, WordsOfAnyBytes) {
  const Canvas canvas = Canvas::pixels(1, 1, kWhite);
  EXPECT_EQ(canvas.width_of("\xb0"), canvas.width_of("\xc2\xb0"));
  EXPECT_EQ(canvas.width_of("a\nb"), canvas.width_of("a b"));
  EXPECT_EQ(canvas.width_of(""), 0);
  EXPECT_GT(canvas.width_of("\xff\xfe\xed\xa0\x80"), 0);
  EXPECT_EQ(Canvas::svg(9, 9, kWhite).width_of("wide"), canvas.width_of("wide"));
}

TEST(Canvas, WordsThatAreTooLongEndInDots) {
  const Canvas canvas = Canvas::pixels(1, 1, kWhite);
  EXPECT_EQ(canvas.fitting("short", 100), "short");
  std::string words;
  for (int i = 0; i < 40; ++i) words += "\xc3\xa9";
  for (const double width : {30.0, 31.0, 77.0, 150.0}) {
    const std::string shown = canvas.fitting(words, width);
    EXPECT_TRUE(shown.ends_with("..."));
    EXPECT_LE(canvas.width_of(shown), width);
    EXPECT_GT(canvas.width_of(shown), width - 12);
    EXPECT_EQ(shown.size() % 2, 1u) << "half a character";
  }
  EXPECT_EQ(canvas.fitting("word", 0), "...");
}

TEST(Canvas, PixelsOfRectanglesAreWhole) {
  Canvas canvas = Canvas::pixels(8, 6, kWhite, 2);
  canvas.fill(1, 2, 3, 1, {1, 2, 3});
  const Picture p = canvas.finish_picture();
  EXPECT_EQ(p.width, 16);
  const Inked box = inked(p);
  EXPECT_EQ(box.left, 2);
  EXPECT_EQ(box.right, 8);
  EXPECT_EQ(box.top, 4);
  EXPECT_EQ(box.bottom, 6);
  EXPECT_EQ(std::count(p.rgb.begin(), p.rgb.end(), 2), 12);
}

TEST(Canvas, APictureBelowStaysAsItIs) {
  Picture picture = make_picture(5, 3, {});
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = static_cast<std::uint8_t>(5 * i);
  Canvas canvas = Canvas::over(picture);
  canvas.write({-90, -90}, "outside");
  EXPECT_EQ(canvas.finish_picture().rgb, picture.rgb);
}

TEST(Canvas, LinesAreAsWideAsAsked) {
  for (const double width : {1.0, 2.0, 6.0}) {
    Canvas canvas = Canvas::pixels(40, 40, kWhite);
    canvas.stroke({{10, 20}, {30, 20}}, kBlack, width);
    const Picture p = canvas.finish_picture();
    double ink = 0;
    for (int y = 0; y < 40; ++y) ink += 1 - p.rgb[static_cast<std::size_t>(3 * (40 * y + 20))] / 255.0;
    EXPECT_NEAR(ink, width, 0.02);
  }
  Canvas canvas = Canvas::pixels(40, 40, kWhite);
  canvas.stroke({{0, 20}, {40, 20}}, kBlack, 2, true);
  const Picture p = canvas.finish_picture();
  double ink = 0;
  for (int x = 0; x < 40; ++x) ink += 1 - p.rgb[static_cast<std::size_t>(3 * (40 * 20 + x))] / 255.0;
  EXPECT_NEAR(ink, 24, 0.1) << "six of ten";
  Canvas none = Canvas::pixels(4, 4, kWhite);
  none.stroke({{1, 1}}, kBlack, 2);
  EXPECT_EQ(none.finish_picture().rgb, make_picture(4, 4, kWhite).rgb);
}

TEST(Canvas, SameCallsGiveTheSameBytes) {
  const auto draw = [] {
    Canvas canvas = Canvas::svg(90, 50, kWhite);
    canvas.stroke({{1, 1}, {30, 20.3}}, kBlack, 1.5, true);
    canvas.dot({30, 20.3}, 3, kBlack);
    canvas.write({45, 25}, "a < b & c", {.align = Align::middle});
    return canvas.finish_svg();
  };
  const std::string svg = draw();
  EXPECT_EQ(svg, draw());
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_EQ(svg.find("surface"), std::string::npos);
}

}  // namespace
}  // namespace phos
