#include "file/csv.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "core/error.h"

namespace phos {

namespace {

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r')) s.remove_suffix(1);
  return s;
}

/// Walks over the text, row by row.
class Reader {
 public:
  Reader(std::string_view text, const std::string& where) : rest_(text), where_(where) {}

  bool at_end() const { return rest_.empty(); }
  std::size_t line() const { return line_; }

  /// The cells of the next row; none for an empty line or a remark.
  std::vector<std::string> row() {
    const std::string_view whole = trimmed(rest_.substr(0, rest_.find('\n')));
    if (whole.empty() || whole.front() == '#') {
      skip_line();
      return {};
    }
    std::vector<std::string> cells;
    do {
      cells.push_back(cell());
    } while (take(','));
    if (!take('\n') && !rest_.empty()) fail("text follows a closing quote");
    ++line_;
    return cells;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ExitCode::bad_input, text(where_, ":", line_), what);
  }
  bool take(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void skip_line() {
    const std::size_t end = rest_.find('\n');
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
  }
  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\r'))
      rest_.remove_prefix(1);
  }
  std::string cell() {
    skip_blanks();
    if (take('"')) return quoted();
    const std::size_t end = std::min(rest_.find_first_of(",\n"), rest_.size());
    const std::string_view plain = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end);
    return std::string(plain);
  }
  std::string quoted() {
    std::string out;
    std::size_t lines = 0;
    for (;;) {
      const std::size_t end = rest_.find('"');
      if (end == std::string_view::npos) fail("a quote is not closed");
      const std::string_view part = rest_.substr(0, end);
      out += part;
      lines += static_cast<std::size_t>(std::count(part.begin(), part.end(), '\n'));
      rest_.remove_prefix(end + 1);
      if (!take('"')) break;
      out += '"';
    }
    line_ += lines;
    skip_blanks();
    return out;
  }

  std::string_view rest_;
  const std::string& where_;
  std::size_t line_ = 1;
};

void check_names(const CsvTable& table, std::size_t line) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (std::count(table.columns.begin(), table.columns.end(), table.columns[i]) > 1)
      throw Error(ExitCode::bad_input, text(table.where, ":", line),
                  text("names the column \"", table.columns[i], "\" twice"));
}

}  // namespace

bool is_plain_text(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](char c) {
    return static_cast<unsigned char>(c) >= ' ' || c == '\t' || c == '\r' || c == '\n';
  });
}

CsvTable parse_csv(std::string_view bytes, const std::string& where) {
  if (!is_plain_text(bytes))
    throw Error(ExitCode::bad_input, where, "is not text; expected comma-separated values");
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  CsvTable table;
  table.where = where;
  Reader reader(bytes, where);
  while (!reader.at_end()) {
    const std::size_t line = reader.line();
    std::vector<std::string> cells = reader.row();
    if (cells.empty()) continue;
    if (table.columns.empty()) {
      table.columns = std::move(cells);
      check_names(table, line);
      continue;
    }
    if (cells.size() != table.columns.size())
      throw Error(ExitCode::bad_input, text(where, ":", line),
                  text("has ", cells.size(), " values under ", table.columns.size(), " names"));
    table.rows.push_back(std::move(cells));
    table.line.push_back(line);
  }
  if (table.columns.empty())
    throw Error(ExitCode::bad_input, where, "is empty; expected a line of names and comma-separated values");
  return table;
}

std::size_t CsvTable::column(const std::string& name, const std::string& option) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
  throw Error(ExitCode::usage, option, text(where, " has no column \"", name, "\"; it has ", names()));
}

std::string CsvTable::names() const {
  std::string all;
  for (const std::string& c : columns) all += (all.empty() ? "" : ", ") + c;
  return all;
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  std::string_view s = rows[row][column];
  if (s.empty() || s == "-") return std::numeric_limits<double>::quiet_NaN();
  if (s.front() == '+') s.remove_prefix(1);
  double v = 0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), v);
  if (error == std::errc() && end == s.data() + s.size()) return v;
  throw Error(ExitCode::bad_input, text(where, ":", line[row]),
              text("\"", rows[row][column], "\" under \"", columns[column], "\" is no number"));
}

}  // namespace phos
