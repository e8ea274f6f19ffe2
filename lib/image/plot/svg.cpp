#include <cstdio>

#include "core/error.h"
#include "core/text/markup.h"
#include "image/plot/pen.h"

namespace phos::inline image {

namespace {

std::string hex(const Colour8& c) {
  char s[8];
  std::snprintf(s, sizeof s, "#%02x%02x%02x", c[0], c[1], c[2]);
  return s;
}

std::string to_hundredth(double v) {
  char s[48];
  std::snprintf(s, sizeof s, "%.2f", v);
  return s;
}

}  // namespace

SvgPen::SvgPen(int width, int height)
    : svg_(text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"", width, "\" height=\"", height,
                "\" viewBox=\"0 0 ", width, " ", height,
                "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"", kLetter, "\">\n",
                "<rect width=\"100%\" height=\"100%\" fill=\"", hex(kPaper), "\"/>\n")) {}

void SvgPen::stroke(const std::vector<PlotPoint>& path, const Colour8& colour, double width, bool dashes) {
  svg_ += text("<polyline fill=\"none\" stroke=\"", hex(colour), "\" stroke-width=\"", to_hundredth(width),
               "\"", dashes ? " stroke-dasharray=\"6 4\"" : "", " points=\"");
  for (std::size_t i = 0; i < path.size(); ++i)
    svg_ += text(i > 0 ? " " : "", to_hundredth(path[i].x), ",", to_hundredth(path[i].y));
  svg_ += "\"/>\n";
}

void SvgPen::dot(const PlotPoint& centre, double radius, const Colour8& colour) {
  svg_ += text("<circle cx=\"", to_hundredth(centre.x), "\" cy=\"", to_hundredth(centre.y), "\" r=\"",
               to_hundredth(radius), "\" fill=\"", hex(colour), "\"/>\n");
}

void SvgPen::write(const PlotPoint& at, const std::string& words, Align align, bool upwards) {
  const char* anchor = align == Align::left ? "start" : align == Align::middle ? "middle" : "end";
  const std::string x = to_hundredth(at.x), y = to_hundredth(at.y);
  const std::string turn = upwards ? text(" transform=\"rotate(-90 ", x, " ", y, ")\"") : "";
  svg_ += text("<text x=\"", x, "\" y=\"", y, "\" dy=\"0.35em\" text-anchor=\"", anchor, "\" fill=\"",
               hex(kInk), "\"", turn, ">", markup_text(words), "</text>\n");
}

double SvgPen::width_of(const std::string& words) const {
  return 0.58 * kLetter * static_cast<double>(words.size());
}

}  // namespace phos::inline image
