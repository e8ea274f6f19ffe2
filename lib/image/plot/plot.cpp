#include "image/plot/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/error.h"
#include "image/plot/style.h"

namespace phos::inline image {

namespace {

constexpr Colour8 kGrid{224, 224, 224};
constexpr std::size_t kColours = std::size(kLineColours);
constexpr std::size_t kMostMarks = 60;  // points of a line that are marked

Colour8 colour_of(std::size_t line) { return kLineColours[line % kColours]; }
/// After the colours come dashes.
bool dashed(std::size_t line) { return line / kColours % 2 == 1; }

bool shows(const PlotAxis& axis, double v) {
  return std::isfinite(v) && (axis.scale == Scale::linear || v > 0);
}
bool shows(const Plot& plot, const PlotPoint& p) { return shows(plot.x, p.x) && shows(plot.y, p.y); }

FalseColourRange range_of(const Plot& plot, const PlotAxis& axis, double PlotPoint::*which) {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for (const PlotLine& line : plot.lines)
    for (const PlotPoint& p : line.points)
      if (shows(plot, p)) lo = std::min(lo, p.*which), hi = std::max(hi, p.*which);
  for (const PlotLine& line : plot.lines)
    for (const PlotLine::Bar& bar : line.bars)
      for (const PlotPoint& p : {PlotPoint{bar.x, bar.lo}, PlotPoint{bar.x, bar.hi}})
        if (shows(plot, p)) lo = std::min(lo, p.*which), hi = std::max(hi, p.*which);
  if (!(lo <= hi)) throw Error(ExitCode::bad_input, "", "no point of the plot can be shown");
  const std::string name = axis.label.empty() ? "axis" : text("axis \"", axis.label, "\"");
  if (axis.scale == Scale::logarithmic) {
    if ((axis.min && !(*axis.min > 0)) || (axis.max && !(*axis.max > 0)))
      throw Error(ExitCode::usage, name, "a logarithmic axis starts above 0");
    lo = round_down_125(lo), hi = round_up_125(hi);
    if (!(lo < hi)) lo /= 2, hi *= 2;
  } else {
    if (!(lo < hi)) {
      const double room = lo == 0 ? 1 : std::fabs(lo) / 2;
      lo -= room, hi += room;
    }
    // Zero is shown where that costs little.
    if (lo > 0 && lo < 0.5 * hi) lo = 0;
    const double step = round_up_125((hi - lo) / 10);
    lo = step * std::floor(lo / step + 1e-6), hi = step * std::ceil(hi / step - 1e-6);
  }
  lo = axis.min.value_or(lo), hi = axis.max.value_or(hi);
  if (!(lo < hi)) throw Error(ExitCode::usage, name, text("the range from ", lo, " to ", hi, " is empty"));
  return {axis.scale, lo, hi};
}

double share(const FalseColourRange& range, double v) {
  if (range.scale == Scale::linear) return (v - range.lo) / (range.hi - range.lo);
  return std::log(v / range.lo) / std::log(range.hi / range.lo);
}

std::string number(double v) {
  if (v == 0) return "0";
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.6g", v);
  std::string s = digits;
  // 1e-05 is 1e-5.
  if (const std::size_t e = s.find('e'); e != std::string::npos) {
    std::string exponent = s.substr(e + 2);
    exponent.erase(0, std::min(exponent.find_first_not_of('0'), exponent.size() - 1));
    s = s.substr(0, e + 1) + (s[e + 1] == '-' ? "-" : "") + exponent;
  }
  return s;
}

/// A rectangle on the paper, x and y to the right and downwards.
struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
};

class Drawing {
 public:
  Drawing(const Plot& plot, Canvas& canvas)
      : plot_(plot),
        canvas_(canvas),
        x_(range_of(plot, plot.x, &PlotPoint::x)),
        y_(range_of(plot, plot.y, &PlotPoint::y)) {
    PHOS_CHECK(plot.width >= 320 && plot.height >= 200, plot.width, " x ", plot.height);
  }

  void draw() {
    lay_out();
    axes();
    for (std::size_t i = 0; i < plot_.lines.size(); ++i) line(i);
    canvas_.stroke({{box_.left, box_.top},
                    {box_.right, box_.top},
                    {box_.right, box_.bottom},
                    {box_.left, box_.bottom},
                    {box_.left, box_.top}},
                   kInk, 1, false);
    legend();
  }

 private:
  static constexpr double kGap = 10, kSample = 24;

  void lay_out() {
    marks_x_ = scale_marks(x_, std::max(2, plot_.width / 90));
    marks_y_ = scale_marks(y_, std::max(2, plot_.height / 50));
    double numbers = 0, names = 0;
    for (const double v : marks_y_) numbers = std::max(numbers, canvas_.width_of(number(v)));
    for (const PlotLine& line : plot_.lines) names = std::max(names, canvas_.width_of(line.name));
    box_.left = kGap + (plot_.y.label.empty() ? 0 : kLetter + kGap) + numbers + kGap;
    const double last = marks_x_.empty() ? 0 : canvas_.width_of(number(marks_x_.back())) / 2 + kGap / 2;
    box_.right = plot_.width - std::max(2 * kGap, last) - (names > 0 ? kSample + names + 2 * kGap : 0);
    box_.right = std::max(box_.right, box_.left + 0.4 * plot_.width);
    box_.top = kGap + (plot_.title.empty() ? 0 : kLetter + kGap);
    box_.bottom = plot_.height - 2 * kGap - kLetter - (plot_.x.label.empty() ? 0 : kLetter + kGap);
  }

  double right_of(double x) const { return box_.left + share(x_, x) * (box_.right - box_.left); }
  double down_to(double y) const { return box_.bottom - share(y_, y) * (box_.bottom - box_.top); }

  /// Words about a place, moved or shortened so that they stay on the paper.
  void along(PlotPoint at, const std::string& words, bool upwards = false) {
    const double room = upwards ? plot_.height : plot_.width;
    const std::string shown = canvas_.fitting(words, room - 2 * kGap);
    const double half = canvas_.width_of(shown) / 2, end = std::max(kGap + half, room - kGap - half);
    double& place = upwards ? at.y : at.x;
    place = std::clamp(place, kGap + half, end);
    canvas_.write(at, shown, {.align = Align::middle, .upwards = upwards});
  }

  void axes() {
    double free_from = 0;
    for (const double v : marks_x_) {
      const double at = right_of(v), half = canvas_.width_of(number(v)) / 2;
      canvas_.stroke({{at, box_.top}, {at, box_.bottom}}, kGrid, 1, false);
      if (at - half < free_from) continue;  // numbers do not run into each other
      free_from = at + half + kGap / 2;
      canvas_.write({at, box_.bottom + kGap + kLetter / 2}, number(v), {.align = Align::middle});
    }
    for (const double v : marks_y_) {
      const double at = down_to(v);
      canvas_.stroke({{box_.left, at}, {box_.right, at}}, kGrid, 1, false);
      canvas_.write({box_.left - kGap, at}, number(v), {.align = Align::right});
    }
    const double x = (box_.left + box_.right) / 2, y = (box_.top + box_.bottom) / 2;
    if (!plot_.title.empty()) along({x, kGap + kLetter / 2}, plot_.title);
    if (!plot_.x.label.empty()) along({x, plot_.height - kGap - kLetter / 2}, plot_.x.label);
    if (!plot_.y.label.empty()) along({kGap + kLetter / 2, y}, plot_.y.label, true);
  }

  /// The part of a to b within the box, or nothing (Liang and Barsky 1984).
  std::vector<PlotPoint> clipped(const PlotPoint& a, const PlotPoint& b) const {
    double from = 0, to = 1;
    const double dx = b.x - a.x, dy = b.y - a.y;
    const auto keep = [&](double step, double room) {
      if (step == 0) return room >= 0;
      (step < 0 ? from : to) = step < 0 ? std::max(from, room / step) : std::min(to, room / step);
      return true;
    };
    if (!keep(-dx, a.x - box_.left) || !keep(dx, box_.right - a.x) || !keep(-dy, a.y - box_.top) ||
        !keep(dy, box_.bottom - a.y) || from > to)
      return {};
    return {{a.x + from * dx, a.y + from * dy}, {a.x + to * dx, a.y + to * dy}};
  }
  bool inside(const PlotPoint& p) const {
    constexpr double kSlack = 1e-6;
    return p.x >= box_.left - kSlack && p.x <= box_.right + kSlack && p.y >= box_.top - kSlack &&
           p.y <= box_.bottom + kSlack;
  }

  /// A bar with short ends. One whose lower end has no place on the axis begins at the axis.
  void upright(const PlotLine::Bar& bar, const Colour8& colour) {
    if (!shows(plot_, {bar.x, bar.hi}) || std::isnan(bar.lo)) return;
    const double x = right_of(bar.x), half = 3;
    const double low = shows(plot_.y, bar.lo) ? down_to(bar.lo) : box_.bottom;
    const std::vector<PlotPoint> part = clipped({x, down_to(bar.hi)}, {x, low});
    if (part.empty()) return;
    canvas_.stroke(part, colour, 1, false);
    for (const PlotPoint& end : part)
      if (inside({end.x - half, end.y}) && inside({end.x + half, end.y}) && end.y < box_.bottom - 1e-6)
        canvas_.stroke({{end.x - half, end.y}, {end.x + half, end.y}}, colour, 1, false);
  }

  void line(std::size_t index) {
    const std::vector<PlotPoint>& points = plot_.lines[index].points;
    const Colour8 colour = colour_of(index);
    const bool joined = plot_.lines[index].joined;
    for (const PlotLine::Bar& bar : plot_.lines[index].bars) upright(bar, colour);
    std::vector<PlotPoint> path;
    const auto finish = [&] {
      if (path.size() > 1 && joined) canvas_.stroke(path, colour, 2, dashed(index));
      path.clear();
    };
    const PlotPoint* before = nullptr;
    PlotPoint last;
    for (const PlotPoint& p : points) {
      if (!shows(plot_, p)) {
        before = nullptr;
        finish();
        continue;
      }
      const PlotPoint at{right_of(p.x), down_to(p.y)};
      if (before) {
        const std::vector<PlotPoint> part = clipped(last, at);
        if (part.empty() || path.empty() || part[0].x != path.back().x || part[0].y != path.back().y)
          finish();
        if (!part.empty()) {
          if (path.empty()) path.push_back(part[0]);
          path.push_back(part[1]);
        }
      }
      before = &p, last = at;
      if ((points.size() <= kMostMarks || !joined) && inside(at)) canvas_.dot(at, 3, colour);
    }
    finish();
  }

  void legend() {
    double y = box_.top + kLetter / 2;
    for (std::size_t i = 0; i < plot_.lines.size(); ++i) {
      if (plot_.lines[i].name.empty()) continue;
      const double x = box_.right + 2 * kGap;
      if (plot_.lines[i].joined)
        canvas_.stroke({{x, y}, {x + kSample, y}}, colour_of(i), 2, dashed(i));
      else
        canvas_.dot({x + kSample / 2, y}, 3, colour_of(i));
      canvas_.write({x + kSample + kGap / 2, y},
                    canvas_.fitting(plot_.lines[i].name, plot_.width - kGap - (x + kSample + kGap / 2)));
      y += kLetter + kGap / 2;
    }
  }

  const Plot& plot_;
  Canvas& canvas_;
  FalseColourRange x_, y_;
  std::vector<double> marks_x_, marks_y_;
  Box box_;
};

}  // namespace

std::size_t points_left_out(const Plot& plot) {
  std::size_t n = 0;
  for (const PlotLine& line : plot.lines)
    for (const PlotPoint& p : line.points) n += shows(plot, p) ? 0 : 1;
  return n;
}

std::string plot_svg(const Plot& plot) {
  Canvas canvas = Canvas::svg(plot.width, plot.height, kPaper);
  Drawing(plot, canvas).draw();
  return canvas.finish_svg();
}

Picture plot_picture(const Plot& plot, int scale) {
  Canvas canvas = Canvas::pixels(plot.width, plot.height, kPaper, scale);
  Drawing(plot, canvas).draw();
  return canvas.finish_picture();
}

}  // namespace phos::inline image
