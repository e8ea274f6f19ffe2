// Text in columns, for a terminal.
#pragma once

#include <cstddef>
#include <string>

namespace phos {

/// Columns of a page of help.
inline constexpr std::size_t kHelpWidth = 100;

/// Breaks at spaces to `width` columns; every line after the first starts with `indent` spaces.
std::string wrap(const std::string& s, std::size_t indent, std::size_t width = kHelpWidth);

/// One entry of a list: two spaces, `left`, and `right` from `column` on, wrapped; on a line of its own where
/// `left` is too long. Ends with a newline.
std::string list_entry(const std::string& left, const std::string& right, std::size_t column,
                       std::size_t width = kHelpWidth);

}  // namespace phos
