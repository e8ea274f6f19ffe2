#include "core/text/wrap.h"

#include <sstream>

namespace phos {

std::string wrap(const std::string& s, std::size_t indent, std::size_t width) {
  std::string out;
  std::size_t column = indent;
  std::istringstream words(s);
  for (std::string word; words >> word;) {
    if (column > indent && column + 1 + word.size() > width) {
      out += '\n';
      out.append(indent, ' ');
      column = indent;
    }
    if (column > indent) out += ' ', ++column;
    out += word;
    column += word.size();
  }
  return out;
}

std::string list_entry(const std::string& left, const std::string& right, std::size_t column,
                       std::size_t width) {
  std::string s(2, ' ');
  s += left;
  if (s.size() + 2 > column) {
    s += '\n';
    s.append(column, ' ');
  } else {
    s.resize(column, ' ');
  }
  s += wrap(right, column, width);
  s += '\n';
  return s;
}

}  // namespace phos
