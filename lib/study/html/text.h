// Pieces of HTML.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "image/image.h"
#include "study/statistics.h"

namespace phos::inline study {

/// "data:image/png;base64,..."
std::string data_uri(const Picture& picture);
/// "data:image/svg+xml;base64,..."
std::string svg_uri(std::string_view svg);

/// Four digits, for people: "0.01234", "1.2e-07".
std::string short_number(double v);
/// "1.23 (1.1 .. 1.3)", each times `scale`; a mean alone without an interval, "-" where there is none.
std::string interval_text(const MeanInterval& i, double scale = 1);
/// A cell of a table that sorts by the number.
std::string number_cell(double sort_by, const std::string& words);
std::string bytes_text(double bytes);

}  // namespace phos::inline study
