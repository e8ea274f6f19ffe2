// Text within HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace phos {

/// The text with the characters of markup replaced, and control characters left out: fit for elements and
/// quoted attributes.
std::string markup_text(std::string_view s);

}  // namespace phos
