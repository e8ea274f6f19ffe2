// Line plots: where points land, what is left out, the same bytes twice.
#include <gtest/gtest.h>

#include <algorithm>
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

constexpr Colour8 kFirst{0, 114, 178};  // of the first line
constexpr int kScale = 4;

/// Pixels of the first line's colour that touch each other, in units of the plot.
struct Blob {
  double x = 0, y = 0;  ///< the middle of its box
  double width = 0, height = 0;
};

std::vector<Blob> blobs(const Plot& plot) {
  Picture p = plot_picture(plot, kScale);
  const auto first = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= p.width || y >= p.height) return false;
    const std::size_t i =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(p.width) + static_cast<std::size_t>(x));
    const bool is = Colour8{p.rgb[i], p.rgb[i + 1], p.rgb[i + 2]} == kFirst;
    if (is) p.rgb[i] = 255;  // counted
    return is;
  };
  std::vector<Blob> all;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      if (!first(x, y)) continue;
      int left = x, right = x, top = y, bottom = y;
      std::vector<std::pair<int, int>> open{{x, y}};
      while (!open.empty()) {
        const auto [i, j] = open.back();
        open.pop_back();
        left = std::min(left, i), right = std::max(right, i), top = std::min(top, j),
        bottom = std::max(bottom, j);
        for (int di = -1; di <= 1; ++di)
          for (int dj = -1; dj <= 1; ++dj)
            if (first(i + di, j + dj)) open.emplace_back(i + di, j + dj);
      }
      all.push_back({(left + right + 1) / 2.0 / kScale, (top + bottom + 1) / 2.0 / kScale,
                     double{right + 1. - left} / kScale, double{bottom + 1. - top} / kScale});
    }
  std::sort(all.begin(), all.end(), [](const Blob& a, const Blob& b) { return a.x < b.x; });
  return all;
}

Blob tallest(const Plot& plot) {
  const std::vector<Blob> all = blobs(plot);
  return *std::max_element(all.begin(), all.end(),
                           [](const Blob& a, const Blob& b) { return a.height < b.height; });
}

/// The frame is drawn over what lies on it: room about the points keeps theirs whole.
void set_ranges(Plot& plot, double x_min, double x_max, double y_min, double y_max) {
  plot.x.min = x_min, plot.x.max = x_max, plot.y.min = y_min, plot.y.max = y_max;
}

/// Without a name there is no sample in the legend.
Plot marks(const std::vector<PlotPoint>& points) {
  Plot plot = simple();
  set_ranges(plot, -1, 11, -10, 200);
  plot.lines = {{"", points, false}};
  return plot;
}

TEST(Plots, PointsLandWhereTheAxesSay) {
  Plot plot = marks({{0, 0}, {5, 25}, {10, 100}});
  std::vector<Blob> at = blobs(plot);
  ASSERT_EQ(at.size(), 3u);
  EXPECT_NEAR(at[1].x, (at[0].x + at[2].x) / 2, 0.3);
  EXPECT_NEAR(at[1].y, 0.75 * at[0].y + 0.25 * at[2].y, 0.3);
  EXPECT_LT(at[2].y, at[0].y);

  plot.lines[0].points = {{1, 0.01}, {10, 1}, {100, 100}};
  plot.x.scale = plot.y.scale = Scale::logarithmic;
  set_ranges(plot, 0.5, 200, 0.005, 200);
  at = blobs(plot);
  ASSERT_EQ(at.size(), 3u);
  EXPECT_NEAR(at[1].x, (at[0].x + at[2].x) / 2, 0.3);
  EXPECT_NEAR(at[1].y, (at[0].y + at[2].y) / 2, 0.3);
}

TEST(Plots, BothFormsAreReproducible) {
  const Plot plot = simple();
  EXPECT_EQ(plot_svg(plot), plot_svg(plot));
  const Picture p = plot_picture(plot, 2);
  EXPECT_EQ(p.width, 2 * plot.width);
  EXPECT_EQ(p.rgb, plot_picture(plot, 2).rgb);
}

TEST(Plots, PointsThatCannotBeShownBreakTheLine) {
  Plot plot = simple();
  plot.lines = {{"", {{1, 1}, {2, 2}, {3, NAN}, {4, 0}, {5, 3}, {6, 2}, {INFINITY, 1}}}};
  EXPECT_EQ(points_left_out(plot), 2u);
  set_ranges(plot, 0, 7, -1, 4);
  const std::vector<Blob> linear = blobs(plot);
  ASSERT_EQ(linear.size(), 2u);
  plot.y.scale = Scale::logarithmic, plot.y.min = 0.5;
  EXPECT_EQ(points_left_out(plot), 3u);
  const std::vector<Blob> logarithmic = blobs(plot);
  ASSERT_EQ(logarithmic.size(), 2u);
  EXPECT_NEAR(logarithmic[0].width, logarithmic[1].width, 0.5);
  EXPECT_GT(linear[1].width, 1.8 * linear[0].width) << "4 to 6, and 1 to 2";
}

TEST(Plots, MarksAloneWithBars) {
  Plot plot = marks({{0, 0}, {10, 100}});
  plot.lines[0].joined = true;
  EXPECT_EQ(blobs(plot).size(), 1u);
  plot.lines[0].joined = false;
  EXPECT_EQ(blobs(plot).size(), 2u);
  EXPECT_NEAR(blobs(plot)[0].height, 6, 0.5);
  // A bar with its ends.
  const double lowest = blobs(plot)[0].y;
  plot.lines[0].bars = {{5, 40, 180}};
  const std::vector<Blob> with = blobs(plot);
  ASSERT_EQ(with.size(), 3u);
  EXPECT_NEAR(with[1].width, 6, 1.5);
  const double unit = (lowest - with[2].y) / 100;  // of the y axis
  EXPECT_NEAR(with[1].height, 140 * unit, 2);
  EXPECT_NEAR(lowest - with[1].y, 110 * unit, 1);
  // Left to itself, the axis has room for it.
  plot.y.min = plot.y.max = std::nullopt;
  EXPECT_NEAR(tallest(plot).height, with[1].height * 210 / 180, 1.5);
  // On a logarithmic axis one that reaches for 0 begins at the frame.
  plot.y.min = 10;
  plot.y.scale = Scale::logarithmic, plot.lines[0].points = {{5, 50}}, plot.lines[0].bars = {{5, 0, 80}};
  ASSERT_EQ(blobs(plot).size(), 1u);
  EXPECT_GT(blobs(plot)[0].height, 100);
  plot.lines[0].bars = {{5, NAN, 80}};
  ASSERT_EQ(blobs(plot).size(), 1u);
  EXPECT_NEAR(blobs(plot)[0].height, 6, 0.5);
}

TEST(Plots, LinesEndAtTheFrame) {
  Plot plot = marks({{0, 0}, {10, 100}});
  plot.lines[0].joined = true;
  const Blob whole = blobs(plot).at(0);
  plot.y.min = 20, plot.y.max = 40;
  const Blob part = tallest(plot);
  EXPECT_LT(part.width, 0.25 * whole.width);
  EXPECT_GT(part.height, 0.5 * plot.height);
  EXPECT_LT(part.height, plot.height - 40);
  plot.lines[0].points = {{0, 0}, {10, 10}};  // all of it below
  EXPECT_TRUE(blobs(plot).empty());
}

TEST(Plots, ExtremeRangesStayFinite) {
  for (const double size : {1e-300, 1e-6, 1.0, 1e6, 1e300}) {
    for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
      Plot plot = marks({{size, size}, {2 * size, 3 * size}});
      set_ranges(plot, 0.5 * size, 2.5 * size, 0.5 * size, 4 * size);
      plot.x.scale = plot.y.scale = scale;
      EXPECT_EQ(blobs(plot).size(), 2u) << size;
      const std::string svg = plot_svg(plot);
      EXPECT_EQ(svg.find("nan"), std::string::npos) << size;
      EXPECT_EQ(svg.find("inf"), std::string::npos) << size;
      plot.x.min = plot.x.max = plot.y.min = plot.y.max = std::nullopt;
      EXPECT_FALSE(blobs(plot).empty()) << size;
      plot.lines[0].points = {{size, size}};  // a single point, a range of nothing
      EXPECT_FALSE(blobs(plot).empty()) << size;
    }
  }
}

TEST(Plots, WordsStayOnThePaper) {
  Plot plot = simple();
  plot.width = 320, plot.height = 200;
  plot.title = plot.x.label = plot.y.label = plot.lines[0].name = std::string(200, 'W');
  plot.lines[0].points = {{0, 0}, {1e6, 1e6}};
  const Picture p = plot_picture(plot);
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      if (x >= 2 && y >= 2 && x < p.width - 2 && y < p.height - 2) continue;
      EXPECT_EQ(p.rgb[static_cast<std::size_t>(3 * (p.width * y + x))], 255) << x << ", " << y;
    }
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
