// Tables as text: comma-separated values with a line of names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace phos::inline file {

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

/// What stands between the cells of a row.
enum class CsvGap {
  comma,
  blanks,   ///< any number of them; no quotes
  by_line,  ///< commas if the first row has one, else blanks
};

/// Rows one by one. RFC 4180, as spreadsheets write it: quotes, CR LF, a byte order mark; empty lines and
/// those that start with # are passed over.
class CsvReader {
 public:
  /// Refers to the text.
  CsvReader(std::string_view text, std::string where, CsvGap gap = CsvGap::comma);
  /// The cells of the next row; false: there is none. Throws Error(bad_input) for an unclosed quote, or text
  /// after a closing one.
  bool next(std::vector<std::string>& cells);
  /// Line of that row, from 1.
  std::size_t line() const { return row_line_; }
  /// "file:line", for messages.
  std::string where() const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  bool take(char c);
  void skip_line();
  void skip_blanks();
  std::string cell();
  std::string quoted();

  std::string_view rest_;
  std::string where_;
  CsvGap gap_;
  std::size_t line_ = 1, row_line_ = 1;
};

/// A cell as it is written: in quotes where it holds a comma, a quote or a line's end.
std::string csv_cell(const std::string& value);

/// May bytes be text (in ASCII, UTF-8 or Latin-1)? Not if they hold control characters.
bool is_plain_text(std::string_view bytes);

/// A line of names and rows under it, as CsvReader reads them. Throws Error(bad_input) for text without a
/// line of names, names that repeat, binary data, or a row that is longer or shorter than the line of names
/// too.
CsvTable parse_csv(std::string_view text, const std::string& where);

}  // namespace phos::inline file
