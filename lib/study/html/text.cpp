#include "study/html/text.h"

#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/json.h"
#include "core/text/base64.h"
#include "core/text/markup.h"
#include "image/png.h"

namespace phos::inline study {

std::string data_uri(const Picture& picture) {
  std::string uri = "data:image/png;base64,";
  return uri.append(base64(encode_png(picture)));
}

std::string svg_uri(std::string_view svg) {
  std::string uri = "data:image/svg+xml;base64,";
  return uri.append(base64(svg));
}

std::string short_number(double v) {
  if (!std::isfinite(v)) return std::isnan(v) ? "-" : v > 0 ? "inf" : "-inf";
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", v);
  return digits;
}

std::string interval_text(const MeanInterval& i, double scale) {
  std::string words = short_number(scale * i.mean);
  if (i.bounded())
    words.append(" (")
        .append(short_number(scale * i.lo))
        .append(" .. ")
        .append(short_number(scale * i.hi))
        .append(")");
  return words;
}

std::string number_cell(double sort_by, const std::string& words) {
  return text("<td data-v=\"", std::isnan(sort_by) ? "" : shortest(sort_by), "\">", markup_text(words),
              "</td>");
}

std::string bytes_text(double bytes) {
  static constexpr const char* kUnits[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  std::size_t unit = 0;
  for (; bytes >= 1024 && unit + 1 < std::size(kUnits); ++unit) bytes /= 1024;
  return text(short_number(bytes), " ", kUnits[unit]);
}

}  // namespace phos::inline study
