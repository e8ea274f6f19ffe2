// Lists in one word, comma by comma. A backslash before a comma, an equals sign or a backslash makes it part
// of an item.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace phos {

/// Place of the first `c` at or after `from` that no backslash makes part of an item; npos if there is none.
std::size_t find_separator(std::string_view words, char c, std::size_t from = 0);
/// Without the backslashes.
std::string without_escapes(std::string_view item);
/// "a,b\,c" -> "a", "b,c". At least one item, which may be empty; a comma at the end begins none.
std::vector<std::string> split_at_commas(std::string_view words);
/// The same of a list of names that are known: of "a,b,c" with "a,b" and "c" known, these two. Where several
/// ways lead through, the names are as short as can be; where none does, every comma parts.
std::vector<std::string> split_known_names(std::string_view words,
                                           const std::function<bool(const std::string&)>& known);

}  // namespace phos
