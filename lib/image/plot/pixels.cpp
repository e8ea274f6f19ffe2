#include <algorithm>
#include <cmath>

#include "image/plot/pen.h"

namespace phos::inline image {

PixelPen::PixelPen(int width, int height, int scale)
    : scale_(scale), picture_(make_picture(width * scale, height * scale, kPaper)) {}

void PixelPen::stroke(const std::vector<PlotPoint>& path, const Colour8& colour, double width, bool dashes) {
  double along = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const PlotPoint a = path[i], b = path[i + 1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!dashes || !(length > 0)) {
      segment(a, b, width, colour);
      continue;
    }
    for (double s = 0; s < length;) {
      const double within = std::fmod(along + s, 10.0);  // 6 drawn, 4 not
      const double step = std::min(length - s, std::max((within < 6 ? 6 : 10) - within, 1e-3));
      const auto at = [&](double t) {
        return PlotPoint{a.x + (b.x - a.x) * t / length, a.y + (b.y - a.y) * t / length};
      };
      if (within < 6) segment(at(s), at(s + step), width, colour);
      s += step;
    }
    along += length;
  }
}
void PixelPen::dot(const PlotPoint& centre, double radius, const Colour8& colour) {
  segment(centre, centre, 2 * radius, colour);
}
void PixelPen::write(const PlotPoint& at, const std::string& words, Align align, bool upwards) {
  const int width = text_width(words, scale_), height = text_height(scale_);
  const int back = align == Align::left ? 0 : align == Align::middle ? width / 2 : width;
  const int x = to_pixel(at.x), y = to_pixel(at.y);
  if (!upwards) {
    draw_text(picture_, x - back, y - height / 2, scale_, words, kInk);
    return;
  }
  Picture level = make_picture(std::max(width, 1), 2 * height, kPaper);
  draw_text(level, 0, 0, scale_, words, kInk);
  for (int j = 0; j < level.height; ++j)
    for (int i = 0; i < level.width; ++i) {
      const std::size_t from = 3 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(level.width) +
                                    static_cast<std::size_t>(i));
      const Colour8 c{level.rgb[from], level.rgb[from + 1], level.rgb[from + 2]};
      if (c != kPaper) set_pixel(picture_, x - height / 2 + j, y + back - i, c);
    }
}

int PixelPen::to_pixel(double v) const { return static_cast<int>(std::lround(v * scale_)); }

/// A stroke with round ends, its edge smoothed over a pixel.
void PixelPen::segment(const PlotPoint& from, const PlotPoint& to, double width, const Colour8& colour) {
  const double s = scale_, half = 0.5 * width * s;
  const double ax = from.x * s, ay = from.y * s, dx = to.x * s - ax, dy = to.y * s - ay;
  const double length2 = dx * dx + dy * dy;
  const auto first = [](double v) { return static_cast<int>(std::floor(v)); };
  const int x0 = std::max(0, first(std::min(ax, ax + dx) - half - 1)),
            x1 = std::min(picture_.width - 1, first(std::max(ax, ax + dx) + half + 1));
  const int y0 = std::max(0, first(std::min(ay, ay + dy) - half - 1)),
            y1 = std::min(picture_.height - 1, first(std::max(ay, ay + dy) + half + 1));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5 - ax, py = y + 0.5 - ay;
      const double t = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0;
      blend(x, y, colour, std::clamp(half + 0.5 - std::hypot(px - t * dx, py - t * dy), 0.0, 1.0));
    }
}
void PixelPen::blend(int x, int y, const Colour8& colour, double cover) {
  if (cover <= 0) return;
  const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                             static_cast<std::size_t>(x));
  for (std::size_t c = 0; c < 3; ++c) {
    const double old = picture_.rgb[i + c];
    picture_.rgb[i + c] = static_cast<std::uint8_t>(std::lround(old + cover * (colour[c] - old)));
  }
}

}  // namespace phos::inline image
