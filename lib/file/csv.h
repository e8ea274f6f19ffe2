// Tables as text: comma-separated values with a line of names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace phos {

/// Cells as they stand in the file, without quotes and outer blanks.
struct CsvTable {
  std::string where;  ///< for messages
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`
  std::vector<std::size_t> line;               ///< of each row in the file, from 1

  /// "a, b, c"
  std::string names() const;
  /// Throws Error(usage) for `option` if there is no such column, naming those that there are.
  std::size_t column(const std::string& name, const std::string& option) const;
  /// A number; NaN for an empty cell, "nan" or "-". Throws Error(bad_input), naming line and column.
  double number(std::size_t row, std::size_t column) const;
};

/// May bytes be text (in ASCII, UTF-8 or Latin-1)? Not if they hold control characters.
bool is_plain_text(std::string_view bytes);

/// RFC 4180, as spreadsheets write it: quotes, CR LF, a byte order mark; empty lines and those that start
/// with # are left out. Throws Error(bad_input) for text without a line of names, names that repeat, an
/// unclosed quote, binary data, or a row that is longer or shorter than the line of names.
CsvTable parse_csv(std::string_view text, const std::string& where);

}  // namespace phos
