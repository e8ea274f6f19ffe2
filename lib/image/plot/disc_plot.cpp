#include "image/plot/disc_plot.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "image/canvas.h"

namespace phos::inline image {
namespace {

constexpr Colour8 kGround{32, 32, 36}, kWords{235, 235, 235};
constexpr int kGap = 10, kSubPixels = 4;

struct Layout {
  int diameter, letters, title_height, width, height;

  explicit Layout(const DiscPlot& plot) : diameter(plot.diameter) {
    PHOS_CHECK(!plot.rows.empty() && diameter >= 16, plot.rows.size(), " rows of ", diameter, " pixels");
    letters = std::clamp(diameter / 6, 10, kLetter);
    title_height = letters * 4 / 3;
    std::size_t most = 1;
    for (const std::vector<Disc>& row : plot.rows) most = std::max(most, row.size());
    const std::size_t wide = most * static_cast<std::size_t>(diameter + kGap) + kGap;
    const std::size_t high =
        plot.rows.size() * static_cast<std::size_t>(title_height + diameter + kGap) + kGap;
    if (std::max(wide, high) > kMostCanvasPixels)
      throw Error(ExitCode::bad_input, "", text("the picture would have ", wide, " x ", high, " pixels"));
    width = static_cast<int>(wide), height = static_cast<int>(high);
  }

  /// Top left corner of a disc's square.
  int x(std::size_t column, std::size_t columns) const {
    const int taken = static_cast<int>(columns) * (diameter + kGap) - kGap;
    return (width - taken) / 2 + static_cast<int>(column) * (diameter + kGap);
  }
  int y(std::size_t row) const {
    return kGap + static_cast<int>(row) * (title_height + diameter + kGap) + title_height;
  }
};

/// Share of a pixel that lies in the disc. The pixel is told by the place of its upper left corner in the
/// square about the disc.
double share_inside(int x, int y, int diameter) {
  int inside = 0;
  for (int j = 0; j < kSubPixels; ++j)
    for (int i = 0; i < kSubPixels; ++i) {
      const double radius = 0.5 * diameter, dx = x + (i + 0.5) / kSubPixels - radius,
                   dy = y + (j + 0.5) / kSubPixels - radius;
      inside += dx * dx + dy * dy < radius * radius;
    }
  return static_cast<double>(inside) / (kSubPixels * kSubPixels);
}

void draw(const Disc& disc, int left, int top, const DiscPlot& plot,
          const std::function<Colour8(double)>& colour, Picture& picture) {
  const int diameter = plot.diameter;
  const double lo = plot.about_zero ? -plot.hi : plot.lo;
  parallel_for(static_cast<std::size_t>(diameter), 8, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < diameter; ++x) {
      const double share = share_inside(x, y, diameter);
      if (share == 0) continue;
      double u = (2 * x + 1.0) / diameter - 1, v = 1 - (2 * y + 1.0) / diameter;
      if (const double r = std::hypot(u, v); r > 1) u /= r, v /= r;
      const double value = disc.value(u, v);
      const Colour8 ink = std::isnan(value) ? kAbsent : colour((value - lo) / (plot.hi - lo));
      std::uint8_t* pixel =
          &picture.rgb[3 * (static_cast<std::size_t>(top + y) * static_cast<std::size_t>(picture.width) +
                            static_cast<std::size_t>(left + x))];
      for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>(share * ink[c] + (1 - share) * kGround[c] + 0.5);
    }
  });
}

}  // namespace

Picture disc_plot_picture(const DiscPlot& plot) {
  const Layout layout(plot);
  const std::function<Colour8(double)> colour = [&plot](double t) {
    return plot.about_zero ? difference_colour(std::clamp(2 * t - 1, -1.0, 1.0))
                           : palette_colour(Palette::viridis, t);
  };
  Picture picture = make_picture(layout.width, layout.height, kGround);
  for (std::size_t row = 0; row < plot.rows.size(); ++row)
    for (std::size_t i = 0; i < plot.rows[row].size(); ++i)
      draw(plot.rows[row][i], layout.x(i, plot.rows[row].size()), layout.y(row), plot, colour, picture);
  Canvas canvas = Canvas::over(picture);
  const auto size = static_cast<double>(layout.letters);
  for (std::size_t row = 0; row < plot.rows.size(); ++row)
    for (std::size_t i = 0; i < plot.rows[row].size(); ++i)
      canvas.write({layout.x(i, plot.rows[row].size()) + 0.5 * layout.diameter,
                    layout.y(row) - 0.5 * layout.title_height},
                   canvas.fitting(plot.rows[row][i].title, layout.diameter + kGap, size),
                   {.colour = kWords, .size = size, .align = Align::middle});
  std::vector<std::string> figures;
  if (!plot.absent.empty()) figures.push_back("grey: " + plot.absent);
  return with_legend(canvas.finish_picture(), {Scale::linear, plot.about_zero ? -plot.hi : plot.lo, plot.hi},
                     {plot.title, plot.unit, figures, false}, colour);
}

}  // namespace phos::inline image
