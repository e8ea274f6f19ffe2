#include "core/text/markdown.h"

#include <algorithm>

#include "core/error.h"

namespace phos {
namespace {

std::string line(const std::vector<std::string>& cells) {
  std::string s = "|";
  for (const std::string& cell : cells) {
    PHOS_CHECK(cell.find_first_of("|\n") == std::string::npos, cell);
    s += cell.empty() ? " |" : " " + cell + " |";
  }
  return s + "\n";
}

}  // namespace

std::string markdown_table(const std::vector<std::string>& head,
                           const std::vector<std::vector<std::string>>& rows) {
  std::string s = line(head) + "|";
  for (std::size_t i = 0; i < head.size(); ++i) s += "---|";
  s += "\n";
  for (const std::vector<std::string>& row : rows) {
    PHOS_CHECK(row.size() == head.size(), row.size(), " cells of ", head.size());
    s += line(row);
  }
  return s;
}

std::string without_markdown(std::string_view cell) {
  std::string s(cell);
  std::erase(s, '`');
  return s;
}

}  // namespace phos
