// Tables of the manual's pages, and their cells as plain text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace phos {

/// A table of as many columns as `head` has; every row has as many. Cells are Markdown without "|".
std::string markdown_table(const std::vector<std::string>& head,
                           const std::vector<std::vector<std::string>>& rows);

/// Markdown of one cell without its backticks.
std::string without_markdown(std::string_view cell);

}  // namespace phos
