#include "image/plot/contour_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "core/error.h"
#include "image/false_colour.h"
#include "image/plot/style.h"

namespace phos::inline image {

namespace {

std::string figure(double v) {
  char s[32];
  std::snprintf(s, sizeof s, "%.6g", v);
  return s;
}

/// Of the level at an index; low ones blue, high ones red. Dark ones stand out from paper, light ones from
/// pictures, where they have a dark edge.
Colour8 colour_of(std::size_t index, std::size_t levels, bool dark) {
  const double t = levels > 1 ? static_cast<double>(index) / static_cast<double>(levels - 1) : 1;
  Colour8 colour = palette_colour(Palette::turbo, dark ? 0.08 + 0.84 * t : 0.2 + 0.6 * t);
  if (dark)
    for (std::uint8_t& c : colour) c = static_cast<std::uint8_t>(0.8 * c);
  return colour;
}

/// A rectangle on the canvas.
struct Area {
  double left = 0, top = 0, right = 0, bottom = 0;
  bool holds(const Area& a) const {
    return a.left >= left && a.top >= top && a.right <= right && a.bottom <= bottom;
  }
  bool meets(const Area& a) const {
    return a.left < right && a.right > left && a.top < bottom && a.bottom > top;
  }
};

struct Look {
  double size, width;             ///< of letters and of lines, units of the canvas
  Colour8 ink, halo;              ///< of labels
  std::optional<Colour8> edge{};  ///< beside lines
};

double length_of(const std::vector<PlotPoint>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i)
    sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
  return sum;
}

PlotPoint along(const std::vector<PlotPoint>& line, double distance) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const PlotPoint &a = line[i - 1], &b = line[i];
    const double step = std::hypot(b.x - a.x, b.y - a.y);
    if (step > 0 && distance <= step)
      return {a.x + (b.x - a.x) * distance / step, a.y + (b.y - a.y) * distance / step};
    distance -= step;
  }
  return line.back();
}

/// Lines of all levels, then labels where none runs into another.
class Contours {
 public:
  /// `frame`: where the lines lie, from the first value of the field to the last.
  Contours(Canvas& canvas, const Area& frame, const Look& look)
      : canvas_(canvas), frame_(frame), look_(look) {}

  /// Returns levels that have lines and no label.
  std::vector<double> draw(const GridField& field, const std::vector<double>& levels,
                           const std::string& unit) {
    std::vector<std::vector<std::vector<PlotPoint>>> all;
    const double step_x = (frame_.right - frame_.left) / (field.width - 1),
                 step_y = (frame_.bottom - frame_.top) / (field.height - 1);
    for (const double level : levels) {
      all.push_back(contour_lines(field, level));
      for (std::vector<PlotPoint>& line : all.back())
        for (PlotPoint& p : line) p = {frame_.left + p.x * step_x, frame_.top + p.y * step_y};
    }
    for (const bool edge : {true, false}) {
      if (edge && !look_.edge) continue;
      for (std::size_t i = 0; i < levels.size(); ++i)
        for (const std::vector<PlotPoint>& line : all[i])
          canvas_.stroke(line, edge ? *look_.edge : colour_of(i, levels.size(), !look_.edge),
                         edge ? 2 * look_.width : look_.width);
    }
    std::vector<double> unlabelled;
    for (std::size_t i = 0; i < levels.size(); ++i)
      if (!all[i].empty() && !label(std::move(all[i]), figure(levels[i]) + (unit.empty() ? "" : " " + unit)))
        unlabelled.push_back(levels[i]);
    return unlabelled;
  }

 private:
  /// On the longest lines, no more than a few. False: on none.
  bool label(std::vector<std::vector<PlotPoint>> lines, const std::string& words) {
    constexpr int kMost = 4;
    constexpr double kLong = 4;  // widths of the label that a line after the first is long
    const double width = canvas_.width_of(words, look_.size);
    std::vector<std::pair<double, const std::vector<PlotPoint>*>> by_length;
    for (const std::vector<PlotPoint>& line : lines) by_length.emplace_back(length_of(line), &line);
    std::stable_sort(by_length.begin(), by_length.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    int labels = 0;
    for (const auto& [length, line] : by_length) {
      if (labels >= kMost || (labels > 0 && length < kLong * width)) break;
      labels += label(*line, length, width, words) ? 1 : 0;
    }
    return labels > 0;
  }

  bool label(const std::vector<PlotPoint>& line, double length, double width, const std::string& words) {
    const double half_x = 0.5 * width + 0.2 * look_.size, half_y = 0.6 * look_.size;
    for (const double share : {0.5, 0.25, 0.75, 0.125, 0.375, 0.625, 0.875, 0.0625, 0.9375}) {
      const PlotPoint at = along(line, share * length);
      const Area box{at.x - half_x, at.y - half_y, at.x + half_x, at.y + half_y};
      if (!frame_.holds(box) ||
          std::any_of(taken_.begin(), taken_.end(), [&](const Area& a) { return a.meets(box); }))
        continue;
      taken_.push_back(box);
      if (!look_.edge)  // the line is interrupted
        canvas_.fill(box.left, box.top, box.right - box.left, box.bottom - box.top, look_.halo);
      canvas_.write(at, words,
                    {.colour = look_.ink, .size = look_.size, .align = Align::middle, .halo = look_.halo});
      return true;
    }
    return false;
  }

  Canvas& canvas_;
  Area frame_;
  Look look_;
  std::vector<Area> taken_;
};

class Plan {
 public:
  explicit Plan(const ContourPlan& plan) : plan_(plan) {
    PHOS_CHECK(plan.width >= 320 && plan.field.width >= 2 && plan.field.height >= 2, plan.width, ", ",
               plan.field.width, " x ", plan.field.height);
    const Canvas ruler = Canvas::pixels(1, 1, kPaper);
    double names = 0, metres = 0;
    for (const double level : plan.levels) names = std::max(names, ruler.width_of(name(level)));
    const double cells_x = plan.field.width - 1, cells_y = plan.field.height - 1;
    // No higher than twice its width.
    const double room = plan.width - 6 * kGap - kLetter - kSample - names;
    double cell = std::max(0.3 * plan.width, room - 60) / cells_x;
    cell = std::min(cell, 2 * plan.width / cells_y);
    marks_x_ = marks(plan.x0_m, cells_x, cell), marks_z_ = marks(plan.z0_m, cells_y, cell);
    for (const double z : marks_z_) metres = std::max(metres, ruler.width_of(figure(z)));
    frame_.left = kGap + kLetter + kGap + metres + kGap;
    frame_.top = plan.title.empty() ? 1.5 * kGap : 2 * kGap + kLetter;
    frame_.right = frame_.left + cells_x * cell, frame_.bottom = frame_.top + cells_y * cell;
    cell_ = cell;
  }

  int height() const {
    const double words = frame_.top + static_cast<double>(plan_.levels.size()) * kLine;
    return static_cast<int>(std::ceil(std::max(frame_.bottom + 2 * kGap + 2 * kLetter + kGap, words + kGap)));
  }

  void draw(Canvas& canvas) const {
    if (!plan_.title.empty())
      canvas.write({plan_.width / 2.0, kGap + kLetter / 2.0},
                   canvas.fitting(plan_.title, plan_.width - 2 * kGap), {.align = Align::middle});
    axes(canvas);
    Contours(canvas, frame_, {12, 1.6, kInk, kPaper}).draw(plan_.field, plan_.levels, plan_.unit);
    canvas.stroke({{frame_.left, frame_.top},
                   {frame_.right, frame_.top},
                   {frame_.right, frame_.bottom},
                   {frame_.left, frame_.bottom},
                   {frame_.left, frame_.top}},
                  kInk, 1);
    legend(canvas);
  }

 private:
  static constexpr double kGap = 10, kSample = 24, kLine = kLetter + 5;

  std::string name(double level) const {
    return figure(level) + (plan_.unit.empty() ? "" : " " + plan_.unit);
  }

  std::vector<double> marks(double first, double cells, double cell) const {
    return scale_marks({Scale::linear, first, first + cells * plan_.spacing_m},
                       std::clamp(static_cast<int>(cells * cell / 70), 1, 10));
  }

  void axes(Canvas& canvas) const {
    const double unit = cell_ / plan_.spacing_m;
    double free_from = 0;
    for (const double x : marks_x_) {
      const double at = frame_.left + (x - plan_.x0_m) * unit, half = canvas.width_of(figure(x)) / 2;
      canvas.stroke({{at, frame_.bottom}, {at, frame_.bottom + kGap / 2}}, kInk, 1);
      if (at - half < free_from) continue;
      free_from = at + half + kGap / 2;
      canvas.write({at, frame_.bottom + kGap + kLetter / 2.0}, figure(x), {.align = Align::middle});
    }
    for (const double z : marks_z_) {
      const double at = frame_.top + (z - plan_.z0_m) * unit;
      canvas.stroke({{frame_.left - kGap / 2, at}, {frame_.left, at}}, kInk, 1);
      canvas.write({frame_.left - kGap, at}, figure(z), {.align = Align::right});
    }
    canvas.write({(frame_.left + frame_.right) / 2, frame_.bottom + 2 * kGap + 1.5 * kLetter}, "x, m",
                 {.align = Align::middle});
    canvas.write({kGap + kLetter / 2.0, (frame_.top + frame_.bottom) / 2}, "z, m",
                 {.align = Align::middle, .upwards = true});
  }

  void legend(Canvas& canvas) const {
    const double x = frame_.right + 2 * kGap;
    double y = frame_.top + kLetter / 2.0;
    for (std::size_t i = 0; i < plan_.levels.size(); ++i, y += kLine) {
      canvas.stroke({{x, y}, {x + kSample, y}}, colour_of(i, plan_.levels.size(), true), 2);
      canvas.write({x + kSample + kGap / 2, y}, name(plan_.levels[i]));
    }
  }

  const ContourPlan& plan_;
  std::vector<double> marks_x_, marks_z_;
  Area frame_;
  double cell_ = 1;
};

}  // namespace

ContouredPicture contours_over(const Picture& picture, const GridField& field,
                               const std::vector<double>& levels, const std::string& unit) {
  PHOS_CHECK(field.width <= picture.width && field.height <= picture.height, field.width, " x ",
             field.height);
  if (std::max(picture.width, picture.height) > kMostCanvasPixels)
    throw Error(ExitCode::bad_input, "",
                text("lines are drawn on at most ", kMostCanvasPixels, " pixels a side, not on ",
                     picture.width, " x ", picture.height));
  if (field.width < 2 || field.height < 2) return {picture, {}};
  constexpr Colour8 kDark{16, 16, 16}, kBright{255, 255, 255};
  const double size = letters_of_picture(field.height);
  Canvas canvas = Canvas::over(picture);
  Contours contours(canvas, {0.5, 0.5, field.width - 0.5, field.height - 0.5},
                    {size, size / 9, kBright, kDark, kDark});
  std::vector<double> unlabelled = contours.draw(field, levels, unit);
  return {canvas.finish_picture(), std::move(unlabelled)};
}

std::string contour_plan_svg(const ContourPlan& plan) {
  const Plan drawing(plan);
  Canvas canvas = Canvas::svg(plan.width, drawing.height(), kPaper);
  drawing.draw(canvas);
  return canvas.finish_svg();
}

Picture contour_plan_picture(const ContourPlan& plan, int scale) {
  const Plan drawing(plan);
  Canvas canvas = Canvas::pixels(plan.width, drawing.height(), kPaper, scale);
  drawing.draw(canvas);
  return canvas.finish_picture();
}

}  // namespace phos::inline image
