#include "image/plot/polar_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/error.h"
#include "image/false_colour.h"
#include "image/plot/style.h"

namespace phos::inline image {
namespace {

constexpr Colour8 kGrid{205, 205, 205};
constexpr std::size_t kColours = 4;  // of the colours of lines
constexpr const char* kDegree = "\xc2\xb0";
constexpr int kStep_deg = 15;
constexpr double kGap = 10, kMargin = 60, kSample = 34;
/// Light above this angle makes the plot a whole circle; else it ends a step above the horizontal.
constexpr double kLowerPart_deg = 100, kUpperEnd_deg = 105;

std::string figure(double v) {
  char s[32];
  std::snprintf(s, sizeof s, "%.6g", v);
  return s;
}

class Drawing {
 public:
  explicit Drawing(const PolarPlot& plot) : plot_(plot) {
    PHOS_CHECK(plot.width >= 400, plot.width, " pixels");
    double most = 0, above = 0;
    for (const PolarCurve& curve : plot.curves)
      for (const PlotPoint& p : curve.points) {
        if (!std::isfinite(p.y)) continue;
        most = std::max(most, p.y);
        if (std::fabs(p.x) > kLowerPart_deg) above = std::max(above, p.y);
      }
    if (!(most > 0)) throw Error(ExitCode::bad_input, "", "no value is above 0: there is nothing to draw");
    // Four to eight circles.
    step_ = round_up_125(most / 7.999);
    rings_ = static_cast<int>(std::ceil(most / step_ - 1e-9));
    end_deg_ = above > 1e-3 * most ? 180 : kUpperEnd_deg;
    radius_ = 0.5 * plot.width - kMargin;
    const double top = kGap + (plot.title.empty() ? 0 : kLetter + kGap) + kLetter + kGap;
    const double above_centre =
        end_deg_ < 180 ? -std::cos(end_deg_ * std::numbers::pi / 180) * radius_ : radius_;
    centre_ = {0.5 * plot.width, top + above_centre};
    below_ = centre_.y + radius_ + kLetter + 2 * kGap;
  }

  int height() const {
    const double lines = static_cast<double>(plot_.caption.size() + 1);
    return static_cast<int>(std::ceil(below_ + lines * (kLetter + 0.6 * kGap) + kGap));
  }

  void draw(Canvas& canvas) const {
    if (!plot_.title.empty())
      canvas.write({centre_.x, kGap + kLetter / 2}, canvas.fitting(plot_.title, plot_.width - 2 * kGap),
                   {.align = Align::middle});
    grid(canvas);
    for (std::size_t i = 0; i < plot_.curves.size(); ++i) {
      std::vector<PlotPoint> path;
      for (const PlotPoint& p : plot_.curves[i].points)
        if (std::isfinite(p.y)) path.push_back(at(p.x, p.y));
      canvas.stroke(path, colour(i), 2.2, i % 2 == 1);
    }
    rings(canvas);
    legend(canvas);
  }

 private:
  static const Colour8& colour(std::size_t i) { return kLineColours[i % kColours]; }

  PlotPoint at(double deg, double value) const {
    const double r = value / (rings_ * step_) * radius_, a = deg * std::numbers::pi / 180;
    return {centre_.x + r * std::sin(a), centre_.y + r * std::cos(a)};
  }

  void grid(Canvas& canvas) const {
    for (int k = 1; k <= rings_; ++k) {
      std::vector<PlotPoint> circle;
      for (int i = -90; i <= 90; ++i) circle.push_back(at(i / 90.0 * end_deg_, k * step_));
      canvas.stroke(circle, kGrid, 1, false);
    }
    for (int deg = -180 + kStep_deg; deg <= 180; deg += kStep_deg) {
      if (std::abs(deg) > end_deg_) continue;
      const bool main = deg % 90 == 0;
      canvas.stroke({at(deg, main || end_deg_ < 180 ? 0 : step_), at(deg, rings_ * step_)}, kGrid,
                    main ? 1.6 : 1, false);
      const PlotPoint end = at(deg, rings_ * step_ * (1 + 0.055 * 314 / radius_));
      const double side = std::sin(deg * std::numbers::pi / 180);
      const Align align = side > 0.3 ? Align::left : side < -0.3 ? Align::right : Align::middle;
      const double back = align == Align::middle ? 0 : align == Align::left ? -8 : 8;
      canvas.write({end.x + back, end.y}, text(std::abs(deg), kDegree), {.align = align});
    }
  }

  void rings(Canvas& canvas) const {
    const int every = rings_ > 5 ? 2 : 1;
    for (int k = every; k <= rings_; k += every) {
      const PlotPoint p = at(0, k * step_);
      canvas.write({p.x + 4, p.y - kLetter / 2 - 1},
                   figure(k * step_) + (k + every > rings_ ? " " + plot_.unit : ""), {.halo = kPaper});
    }
  }

  void legend(Canvas& canvas) const {
    double x = kMargin, y = below_;
    for (std::size_t i = 0; i < plot_.curves.size(); ++i) {
      canvas.stroke({{x, y}, {x + kSample, y}}, colour(i), 2.2, i % 2 == 1);
      canvas.write({x + kSample + kGap / 2, y}, plot_.curves[i].name);
      x += kSample + canvas.width_of(plot_.curves[i].name) + 3 * kGap;
    }
    for (const std::string& line : plot_.caption) {
      y += kLetter + 0.6 * kGap;
      canvas.write({kMargin, y}, canvas.fitting(line, plot_.width - 2 * kMargin));
    }
  }

  const PolarPlot& plot_;
  double step_ = 1, end_deg_ = 180, radius_ = 1, below_ = 0;
  int rings_ = 1;
  PlotPoint centre_;
};

}  // namespace

std::string polar_plot_svg(const PolarPlot& plot) {
  const Drawing drawing(plot);
  Canvas canvas = Canvas::svg(plot.width, drawing.height(), kPaper);
  drawing.draw(canvas);
  return canvas.finish_svg();
}

Picture polar_plot_picture(const PolarPlot& plot, int scale) {
  const Drawing drawing(plot);
  Canvas canvas = Canvas::pixels(plot.width, drawing.height(), kPaper, scale);
  drawing.draw(canvas);
  return canvas.finish_picture();
}

}  // namespace phos::inline image
