// Line plots: where points land, what is left out, the same bytes twice.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "image/plot/csv_plot.h"

namespace phos {
namespace {

Plot simple() {
  Plot plot;
  plot.x.label = "coefficients", plot.y.label = "accuracy [1]";
  plot.lines = {{"hsh", {{0, 0}, {10, 100}}}};
  return plot;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

/// "cx" and "cy" of the circles.
std::vector<PlotPoint> dots(const std::string& svg) {
  std::vector<PlotPoint> all;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) {
    const auto value = [&](const char* key) { return std::stod(svg.substr(svg.find(key, at) + 4)); };
    all.push_back({value("cx="), value("cy=")});
  }
  return all;
}

TEST(Plots, PointsLandWhereTheAxesSay) {
  Plot plot = simple();
  plot.lines[0].points = {{0, 0}, {5, 25}, {10, 100}};
  std::vector<PlotPoint> at = dots(plot_svg(plot));
  ASSERT_EQ(at.size(), 3u);
  EXPECT_NEAR(at[1].x, (at[0].x + at[2].x) / 2, 0.02);
  EXPECT_NEAR(at[1].y, 0.75 * at[0].y + 0.25 * at[2].y, 0.02);
  EXPECT_LT(at[2].y, at[0].y);

  plot.lines[0].points = {{1, 0.01}, {10, 1}, {100, 100}};
  plot.x.scale = plot.y.scale = Scale::logarithmic;
  at = dots(plot_svg(plot));
  ASSERT_EQ(at.size(), 3u);
  EXPECT_NEAR(at[1].x, (at[0].x + at[2].x) / 2, 0.02);
  EXPECT_NEAR(at[1].y, (at[0].y + at[2].y) / 2, 0.02);
}

TEST(Plots, BothFormsShowTheSameAndAreReproducible) {
  const Plot plot = simple();
  EXPECT_EQ(plot_svg(plot), plot_svg(plot));
  const Picture p = plot_picture(plot, 2);
  EXPECT_EQ(p.width, 2 * plot.width);
  EXPECT_EQ(p.rgb, plot_picture(plot, 2).rgb);
  // The line's colour covers about its length times its width.
  std::size_t blue = 0;
  for (std::size_t i = 0; i < p.rgb.size(); i += 3) blue += p.rgb[i] == 0 && p.rgb[i + 2] == 178 ? 1 : 0;
  EXPECT_GT(blue, 2000u);
  EXPECT_LT(blue, 12000u);
}

TEST(Plots, PointsThatCannotBeShownBreakTheLine) {
  Plot plot = simple();
  plot.lines[0].points = {{1, 1}, {2, 2}, {3, NAN}, {4, 0}, {5, 3}, {6, 2}, {INFINITY, 1}};
  EXPECT_EQ(points_left_out(plot), 2u);
  plot.y.scale = Scale::logarithmic;
  EXPECT_EQ(points_left_out(plot), 3u);
  const std::string svg = plot_svg(plot);
  EXPECT_EQ(count(svg, "<circle"), 4u);
  // Two parts, and the sample in the legend.
  EXPECT_EQ(count(svg, "stroke=\"#0072b2\""), 3u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Plots, MarksAloneWithBars) {
  const std::string line = "stroke=\"#0072b2\"";  // of the first colour
  Plot plot = simple();
  plot.lines[0].name.clear();
  EXPECT_EQ(count(plot_svg(plot), line), 1u);
  plot.lines[0].joined = false;
  EXPECT_EQ(count(plot_svg(plot), line), 0u);
  EXPECT_EQ(dots(plot_svg(plot)).size(), 2u);
  // A bar and its two ends; the axis has room for it.
  plot.lines[0].bars = {{5, 40, 180}};
  const std::string svg = plot_svg(plot);
  EXPECT_EQ(count(svg, line), 3u);
  EXPECT_NE(svg.find(">180<"), std::string::npos);
  // On a logarithmic axis one that reaches for 0 begins at the frame, without an end there.
  plot.y.scale = Scale::logarithmic, plot.lines[0].points = {{5, 50}}, plot.lines[0].bars = {{5, 0, 80}};
  EXPECT_EQ(count(plot_svg(plot), line), 2u);
  plot.lines[0].bars = {{5, NAN, 80}};
  EXPECT_EQ(count(plot_svg(plot), line), 0u);
}

TEST(Plots, LinesEndAtTheFrame) {
  Plot plot = simple();
  plot.y.min = 20, plot.y.max = 40;
  for (const PlotPoint& p : dots(plot_svg(plot))) ADD_FAILURE() << p.x << " " << p.y;
  plot.lines[0].points = {{0, 0}, {10, 10}};  // all of it below
  const std::string svg = plot_svg(plot);
  EXPECT_EQ(count(svg, "stroke=\"#0072b2\""), 1u);
}

TEST(Plots, ExtremeRangesStayFinite) {
  for (const double size : {1e-300, 1e-6, 1.0, 1e6, 1e300}) {
    for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
      Plot plot = simple();
      plot.x.scale = plot.y.scale = scale;
      plot.lines[0].points = {{size, size}, {2 * size, 3 * size}};
      const std::string svg = plot_svg(plot);
      EXPECT_EQ(svg.find("nan"), std::string::npos) << size;
      EXPECT_EQ(count(svg, "<circle"), 2u) << size;
      plot.lines[0].points = {{size, size}};  // a single point, a range of nothing
      EXPECT_EQ(count(plot_svg(plot), "<circle"), 1u) << size;
    }
  }
}

TEST(Plots, WordsAreEscaped) {
  Plot plot = simple();
  plot.title = "a < b & c";
  EXPECT_NE(plot_svg(plot).find("a &lt; b &amp; c"), std::string::npos);
}

TEST(Plots, RefusesAxesWithoutRoom) {
  Plot plot = simple();
  plot.x.min = 5, plot.x.max = 5;
  EXPECT_THROW(plot_svg(plot), Error);
  plot = simple();
  plot.y.scale = Scale::logarithmic, plot.y.min = 0;
  EXPECT_THROW(plot_svg(plot), Error);
  plot = simple();
  plot.lines[0].points = {{NAN, 1}};
  EXPECT_THROW(plot_picture(plot), Error);
}

TEST(Plots, OfATable) {
  const CsvTable table = parse_csv(
      "lobe,basis,n,accuracy,time\nphong,sh,4,0.7,1\nphong,hsh,1,0.5,2\nphong,sh,1,0.4,3\nward,sh,9,0.1,4\n",
      "t.csv");
  CsvPlotOptions options;
  options.x = "n", options.y = {"accuracy"}, options.series = "basis", options.where = {"lobe=phong"};
  Plot plot = plot_of(table, options);
  ASSERT_EQ(plot.lines.size(), 2u);
  EXPECT_EQ(plot.lines[0].name, "sh");
  ASSERT_EQ(plot.lines[0].points.size(), 2u);
  EXPECT_EQ(plot.lines[0].points[0].y, 0.4);  // by ascending x
  EXPECT_EQ(plot.lines[0].points[1].x, 4);
  EXPECT_EQ(plot.x.label, "n");
  options.y = {"accuracy", "time"}, options.series = "";
  plot = plot_of(table, options);
  ASSERT_EQ(plot.lines.size(), 2u);
  EXPECT_EQ(plot.lines[1].name, "time");
  EXPECT_EQ(plot.y.label, "accuracy, time");
  options.where = {"lobe=cook"};
  EXPECT_THROW(plot_of(table, options), Error);
  options.where = {"lobe"};
  EXPECT_THROW(plot_of(table, options), Error);
}

}  // namespace
}  // namespace phos
