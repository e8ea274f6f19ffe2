// Lines of equal value: straight on ramps, round about a point, joined, kept out of gaps, labelled.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.h"
#include "image/contouring.h"

namespace phos {
namespace {

GridField field(int width, int height, const std::function<double(int, int)>& value) {
  GridField f{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) f.values.push_back(value(x, y));
  return f;
}

double length_of(const std::vector<PlotPoint>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i)
    sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
  return sum;
}

TEST(Contours, OfARampAreStraight) {
  const GridField ramp = field(11, 7, [](int x, int y) { return 20 * x + 5 * y - 3; });
  for (const double level : {1.0, 50.0, 111.0, 180.0}) {
    const auto lines = contour_lines(ramp, level);
    ASSERT_EQ(lines.size(), 1u) << level;
    for (const PlotPoint& p : lines[0]) EXPECT_NEAR(20 * p.x + 5 * p.y - 3, level, 1e-10);
  }
  // From edge to edge: x = 2.65 - y / 4 for y from 0 to 6.
  EXPECT_NEAR(length_of(contour_lines(ramp, 50)[0]), 6 * std::hypot(1, 0.25), 1e-10);
  EXPECT_TRUE(contour_lines(ramp, 500).empty());
  EXPECT_TRUE(contour_lines(ramp, -3.5).empty());
}

TEST(Contours, AboutAPointAreCircles) {
  const double cx = 40.3, cy = 38.9;
  const GridField cone = field(81, 79, [&](int x, int y) { return 1000 - 10 * std::hypot(x - cx, y - cy); });
  for (const double radius : {5.0, 17.0, 33.3}) {
    const auto lines = contour_lines(cone, 1000 - 10 * radius);
    ASSERT_EQ(lines.size(), 1u) << radius;
    EXPECT_EQ(lines[0].front().x, lines[0].back().x);
    EXPECT_EQ(lines[0].front().y, lines[0].back().y);
    // The second derivative along an edge is at most 1 / r: linear values err by 1 / (8 r) cells.
    for (const PlotPoint& p : lines[0])
      EXPECT_NEAR(std::hypot(p.x - cx, p.y - cy), radius, 1 / (8 * (radius - 1)));
    EXPECT_NEAR(length_of(lines[0]), 2 * std::numbers::pi * radius, 0.02 * radius);
  }
}

TEST(Contours, StayOutOfCellsThatLackAValue) {
  const GridField gap = field(9, 3, [](int x, int y) { return x == 4 && y == 2 ? NAN : 10.0 * y; });
  const auto lines = contour_lines(gap, 15);
  ASSERT_EQ(lines.size(), 2u) << "left and right of the gap";
  EXPECT_NEAR(length_of(lines[0]) + length_of(lines[1]), 6, 1e-12);
  for (const auto& line : lines)
    for (const PlotPoint& p : line) EXPECT_NEAR(p.y, 1.5, 1e-12);
}

TEST(Contours, OfASaddleFollowItsMiddle) {
  const auto saddle = [](double high, double low) {
    return contour_lines({2, 2, {high, low, low, high}}, 10);
  };
  // The middle is above: the lines cut off the low corners (1, 0) and (0, 1).
  auto lines = saddle(30, 0);
  ASSERT_EQ(lines.size(), 2u);
  for (const auto& line : lines) {
    ASSERT_EQ(line.size(), 2u);
    EXPECT_NEAR(std::fabs(line[0].x - line[1].x), 1 / 3.0, 1e-12);
    EXPECT_GT(std::fabs((line[0].x + line[1].x) / 2 - (line[0].y + line[1].y) / 2), 0.5);
  }
  // Below: they cut off the high ones.
  lines = saddle(15, 0);
  ASSERT_EQ(lines.size(), 2u);
  for (const auto& line : lines)
    EXPECT_LT(std::fabs((line[0].x + line[1].x) / 2 - (line[0].y + line[1].y) / 2), 1e-12);
}

TEST(Contours, OfExtremesAreFinite) {
  for (const double most : {1e-300, 1.0, 1.7e308}) {
    const GridField f = field(3, 3, [&](int x, int) { return most * (x - 1); });
    for (const auto& line : contour_lines(f, most / 3))
      for (const PlotPoint& p : line) EXPECT_NEAR(p.x, 4 / 3.0, 1e-9) << most;
  }
  EXPECT_TRUE(contour_lines({0, 0, {}}, 1).empty());
  EXPECT_TRUE(contour_lines(field(5, 5, [](int, int) { return INFINITY; }), 1).empty());
}

TEST(Contours, LevelsAreRound) {
  const auto close = [](const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9 * b[i]);
  };
  close(round_levels(500), {100, 200, 300, 400});
  close(round_levels(1.2), {0.2, 0.4, 0.6, 0.8, 1.0});
  close(round_levels(2600), {500, 1000, 1500, 2000, 2500});
  close(round_levels(0.09), {0.02, 0.04, 0.06, 0.08});
  for (const double most : {0.0, -3.0, double{NAN}, double{INFINITY}})
    EXPECT_TRUE(round_levels(most).empty());
}

/// Pixels of a colour that is near to one.
std::vector<PlotPoint> places(const Picture& p, const std::function<bool(int, int, int)>& is) {
  std::vector<PlotPoint> all;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(3 * (p.width * y + x));
      if (is(p.rgb[i], p.rgb[i + 1], p.rgb[i + 2])) all.push_back({x + 0.5, y + 0.5});
    }
  return all;
}

TEST(Contours, OverAPictureStandAtTheirPixels) {
  // 100 lx where the middle of pixel 99.5 lies, as values belong to the middles of pixels.
  const GridField ramp = field(300, 200, [](int x, int) { return x + 0.5; });
  const ContouredPicture drawn = contours_over(make_picture(300, 200, {128, 128, 128}), ramp, {100}, "lx");
  EXPECT_TRUE(drawn.unlabelled.empty());
  const auto coloured = places(drawn.picture, [](int r, int g, int b) { return r - std::min(g, b) > 100; });
  ASSERT_GT(coloured.size(), 100u);
  for (const PlotPoint& p : coloured) EXPECT_NEAR(p.x, 100, 2);
  // The label is at the middle of the line.
  const auto bright = places(drawn.picture, [](int r, int g, int b) { return std::min({r, g, b}) > 200; });
  ASSERT_GT(bright.size(), 30u);
  for (const PlotPoint& p : bright) {
    EXPECT_NEAR(p.x, 100, 40);
    EXPECT_NEAR(p.y, 100, 10);
  }
  // No room: the line is drawn, and the level is told.
  const GridField narrow = field(20, 20, [](int x, int) { return x + 0.5; });
  const ContouredPicture crowded = contours_over(make_picture(20, 20, {128, 128, 128}), narrow, {10}, "lx");
  EXPECT_EQ(crowded.unlabelled, std::vector<double>{10});
  EXPECT_NE(crowded.picture.rgb, make_picture(20, 20, {128, 128, 128}).rgb);
}

CsvTable plane(double spacing, const std::function<double(double, double)>& lux) {
  std::string csv = "x,z,E_lx\n";
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j)
      csv += text(1 + spacing * i, ",", -2 + spacing * j, ",", lux(1 + spacing * i, -2 + spacing * j), "\n");
  return parse_csv(csv, "t.csv");
}

TEST(Contours, OfATable) {
  const ContourOptions options{"E_lx", {"300", "150", "150"}, 0.1};
  const TableContours c =
      contours_of(plane(0.1, [](double x, double z) { return 100 * x - 50 * z; }), options);
  EXPECT_EQ(c.hidden, 0u);
  EXPECT_EQ(c.plan.field.width, 6);
  EXPECT_EQ(c.plan.field.height, 4);
  EXPECT_EQ(c.plan.unit, "lx");
  EXPECT_EQ(c.plan.levels, (std::vector<double>{150, 300}));
  EXPECT_NEAR(c.plan.field.at(3, 2), 130 + 90, 1e-3);
  EXPECT_EQ(c.plan.x0_m, 1);
  EXPECT_EQ(c.plan.z0_m, -2);
  const Picture picture = contour_plan_picture(c.plan, 2);
  EXPECT_EQ(picture.width, 1440);
  EXPECT_EQ(contour_plan_svg(c.plan), contour_plan_svg(c.plan));
}

TEST(Contours, OfATableRefuseWhatIsNoGrid) {
  const CsvTable table = plane(0.1, [](double x, double) { return x; });
  EXPECT_THROW(contours_of(table, {"df", {}, 0.1}), Error);
  EXPECT_THROW(contours_of(table, {"E_lx", {}, 0.03}), Error) << "no neighbours";
  EXPECT_THROW(contours_of(table, {"E_lx", {}, 1e-9}), Error) << "too many places";
  EXPECT_GT(contours_of(table, {"E_lx", {}, 0.2}).hidden, 0u) << "two at a place";
  EXPECT_THROW(contours_of(parse_csv("x,z,E_lx\n-,0,1\n", "t.csv"), {"E_lx", {}, 1}), Error);
  EXPECT_THROW(check_usage({"E_lx", {"much"}, 0.1}, true), Error);
  EXPECT_THROW(check_usage({"E_lx", {}, {}}, true), Error);
  EXPECT_THROW(check_usage({"illuminance", {}, 0.1}, false), Error);
  EXPECT_THROW(check_usage({"", {"5"}, {}}, false), Error);
  EXPECT_NO_THROW(check_usage({"illuminance", {"5"}, {}}, false));
}

TEST(Contours, LevelsOfAnImageStayForASequence) {
  Image image(40, 30);
  EXPECT_THROW(fixed_levels(image, {"illuminance", {}, {}}), Error);
  image.channel("illuminance.Y");
  EXPECT_TRUE(fixed_levels(image, {"illuminance", {}, {}}).levels.empty()) << "black";
  std::span<float> lux = image.channel("illuminance.Y");
  for (std::size_t i = 0; i < lux.size(); ++i) lux[i] = static_cast<float>(i) / 3;  // up to 400
  const ContourOptions fixed = fixed_levels(image, {"illuminance", {}, {}});
  EXPECT_EQ(fixed.levels, (std::vector<std::string>{"100", "200", "300", "400"}));
  EXPECT_EQ(fixed_levels(image, {"illuminance", {"7"}, {}}).levels, std::vector<std::string>{"7"});
  const ContouredPicture drawn = contoured(image, make_picture(40, 30, {9, 9, 9}), fixed);
  EXPECT_NE(drawn.picture.rgb, make_picture(40, 30, {9, 9, 9}).rgb);
}

}  // namespace
}  // namespace phos
