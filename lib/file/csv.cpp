#include "file/csv.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>

#include "core/error.h"
#include "core/text/append_item.h"
#include "file/lfs_pointer.h"

namespace phos::inline file {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r')) s.remove_suffix(1);
  return s;
}

void check_names(const CsvTable& table, std::size_t line) {
  std::set<std::string_view> known;
  for (const std::string& name : table.columns)
    if (!known.insert(name).second)
      throw Error(ExitCode::bad_input, text(table.where, ":", line),
                  text("names the column \"", name, "\" twice; rename one of them"));
}

}  // namespace

CsvReader::CsvReader(std::string_view text, std::string where, CsvGap gap)
    : rest_(text), where_(std::move(where)), gap_(gap) {
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

std::string CsvReader::where() const { return text(where_, ":", row_line_); }
void CsvReader::fail(const std::string& what) const { throw Error(ExitCode::bad_input, where(), what); }

bool CsvReader::take(char c) {
  if (rest_.empty() || rest_.front() != c) return false;
  rest_.remove_prefix(1);
  return true;
}

void CsvReader::skip_line() {
  const std::size_t end = rest_.find('\n');
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  ++line_;
}

void CsvReader::skip_blanks() {
  while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\r'))
    rest_.remove_prefix(1);
}

bool CsvReader::next(std::vector<std::string>& cells) {
  cells.clear();
  while (!rest_.empty()) {
    const std::string_view whole = trimmed(rest_.substr(0, rest_.find('\n')));
    row_line_ = line_;
    if (whole.empty() || whole.front() == '#') {
      skip_line();
      continue;
    }
    if (gap_ == CsvGap::by_line)
      gap_ = whole.find(',') == std::string_view::npos ? CsvGap::blanks : CsvGap::comma;
    if (gap_ == CsvGap::blanks) {
      for (std::size_t at = 0; at < whole.size();) {
        const std::size_t end = std::min(whole.find_first_of(" \t", at), whole.size());
        if (end > at) cells.emplace_back(whole.substr(at, end - at));
        at = end + 1;
      }
      skip_line();
      return true;
    }
    do {
      cells.push_back(cell());
      if (!rest_.empty() && rest_.front() != ',' && rest_.front() != '\n')
        fail(text("column ", cells.size(), " goes on after its quote"));
    } while (take(','));
    take('\n');
    ++line_;
    return true;
  }
  return false;
}

std::string CsvReader::cell() {
  skip_blanks();
  if (take('"')) return quoted();
  const std::size_t end = std::min(rest_.find_first_of(",\n"), rest_.size());
  const std::string_view plain = trimmed(rest_.substr(0, end));
  rest_.remove_prefix(end);
  return std::string(plain);
}

std::string CsvReader::quoted() {
  std::string out;
  for (;;) {
    const std::size_t end = rest_.find('"');
    if (end == std::string_view::npos) fail("a quote is not closed");
    const std::string_view part = rest_.substr(0, end);
    out += part;
    line_ += static_cast<std::size_t>(std::count(part.begin(), part.end(), '\n'));
    rest_.remove_prefix(end + 1);
    if (!take('"')) break;
    out += '"';
  }
  skip_blanks();
  return out;
}

bool is_plain_text(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](char c) {
    return static_cast<unsigned char>(c) >= ' ' || c == '\t' || c == '\r' || c == '\n';
  });
}

CsvTable parse_csv(std::string_view bytes, const std::string& where) {
  if (!is_plain_text(bytes))
    throw Error(ExitCode::bad_input, where, "is not text; expected comma-separated values");
  if (is_lfs_pointer(bytes)) throw Error(ExitCode::bad_input, where, text("is no table, but ", kLfsPointer));
  CsvTable table;
  table.where = where;
  CsvReader reader(bytes, where);
  std::vector<std::string> cells;
  while (reader.next(cells)) {
    if (table.columns.empty()) {
      table.columns = cells;
      check_names(table, reader.line());
      continue;
    }
    if (cells.size() != table.columns.size())
      throw Error(ExitCode::bad_input, reader.where(),
                  text("has ", cells.size(), " values under ", table.columns.size(), " names"));
    table.rows.push_back(cells);
    table.line.push_back(reader.line());
  }
  if (table.columns.empty())
    throw Error(ExitCode::bad_input, where, "is empty; expected a line of names and comma-separated values");
  return table;
}

std::string csv_cell(const std::string& value) {
  if (value.find_first_of(",\"\n\r") == std::string::npos) return value;
  std::string out = "\"";
  for (const char c : value) out += c == '"' ? std::string(2, c) : std::string(1, c);
  return out + '"';
}

std::size_t CsvTable::column(const std::string& name, const std::string& option) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
  throw Error(ExitCode::usage, option, text(where, " has no column \"", name, "\"; it has ", names()));
}

std::string CsvTable::names() const {
  std::string all;
  for (const std::string& c : columns) append_item(all, c);
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

}  // namespace phos::inline file
