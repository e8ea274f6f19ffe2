#include "splat/picture/overlay_legend.h"

#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "image/canvas.h"
#include "image/false_colour.h"
#include "image/plot/style.h"

namespace phos::inline splat {
namespace {

constexpr Colour8 kGround{24, 24, 24}, kWords{235, 235, 235};
constexpr int kMarks = 5;  // on the scale

/// Sizes in pixels.
Picture legend_of(const DrawnRecords& drawn, const OverlayColourRow& row, int letters) {
  const double line = letters * 4.0 / 3, gap = letters / 2.0;
  const FalseColourRange range{Scale::logarithmic, drawn.least * row.per_unit, drawn.most * row.per_unit};
  const bool one = !(range.hi > range.lo);
  const double bar = 12.0 * letters, margin = std::round(1.5 * letters);
  const int width = static_cast<int>(bar + 2 * margin), height = static_cast<int>(3 * line + 2 * gap);
  Canvas canvas = Canvas::pixels(width, height, kGround);
  const auto write = [&](double x, double y, const std::string& words, Align align) {
    canvas.write({x, y}, words, {.colour = kWords, .size = static_cast<double>(letters), .align = align});
  };
  write(margin, gap + line / 2, text(row.title, ", ", row.unit), Align::left);
  const double top = std::round(gap + line);
  for (int x = 0; x < static_cast<int>(bar); ++x)
    canvas.fill(margin + x, top, 1, line, row.at(one ? 0 : (x + 0.5) / bar));
  const std::vector<double> marks = one ? std::vector<double>{range.lo} : scale_marks(range, kMarks);
  for (const double v : marks) {
    const double x = margin + (one ? 0.5 : std::log(v / range.lo) / std::log(range.hi / range.lo)) * bar;
    canvas.fill(x - 0.5, top + line, 1, gap / 2, kWords);
    write(x, top + 1.5 * line + gap / 2, shortest(static_cast<float>(v)), Align::middle);
  }
  return canvas.finish_picture();
}

}  // namespace

void draw_legend(Image& image, const DrawnRecords& drawn, OverlayColour colour) {
  if (drawn.count == 0 || !(drawn.least > 0)) return;
  const Picture legend = legend_of(drawn, row_of(colour), letters_of_picture(image.height()));
  if (legend.width > image.width() || 2 * legend.height > image.height()) return;
  std::vector<Rgb> picture = image.rgb("");
  const int top = image.height() - legend.height;
  for (int y = 0; y < legend.height; ++y)
    for (int x = 0; x < legend.width; ++x) {
      const std::uint8_t* code = &legend.rgb[3 * static_cast<std::size_t>(y * legend.width + x)];
      picture[static_cast<std::size_t>((top + y) * image.width() + x)] =
          scene_colour({code[0], code[1], code[2]}, drawn.key_cd_m2);
    }
  image.set_rgb("", picture);
}

}  // namespace phos::inline splat
