#include "core/text/comma_list.h"

#include <algorithm>

namespace phos {
namespace {

/// Is the character at `i` a backslash that makes the next one part of an item?
bool escapes(std::string_view words, std::size_t i) {
  return words[i] == '\\' && i + 1 < words.size() &&
         (words[i + 1] == ',' || words[i + 1] == '=' || words[i + 1] == '\\');
}

}  // namespace

std::size_t find_separator(std::string_view words, char c, std::size_t from) {
  for (std::size_t i = from; i < words.size(); ++i) {
    if (escapes(words, i))
      ++i;
    else if (words[i] == c)
      return i;
  }
  return std::string_view::npos;
}

std::string without_escapes(std::string_view item) {
  std::string out;
  for (std::size_t i = 0; i < item.size(); ++i) {
    if (escapes(item, i)) ++i;
    out += item[i];
  }
  return out;
}

std::vector<std::string> split_at_commas(std::string_view words) {
  std::vector<std::string> items;
  std::size_t begin = 0;
  do {
    const std::size_t end = std::min(find_separator(words, ',', begin), words.size());
    items.push_back(without_escapes(words.substr(begin, end - begin)));
    begin = end + 1;
  } while (begin < words.size());
  return items;
}

std::vector<std::string> split_known_names(std::string_view words,
                                           const std::function<bool(const std::string&)>& known) {
  constexpr std::size_t kMostCommas = 32;  // in one name
  const std::vector<std::string> parts = split_at_commas(words);
  // From the last part to the first: how many make a name here, so that names follow up to the end.
  std::vector<std::size_t> taken(parts.size() + 1, 0);
  taken[parts.size()] = 1;
  for (std::size_t i = parts.size(); i-- > 0;) {
    std::string name;
    for (std::size_t n = 1; i + n <= parts.size() && n <= kMostCommas + 1 && taken[i] == 0; ++n) {
      name.append(n > 1 ? "," : "").append(parts[i + n - 1]);
      if (taken[i + n] > 0 && known(name)) taken[i] = n;
    }
  }
  if (taken[0] == 0) return parts;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < parts.size(); i += taken[i]) {
    std::string& name = names.emplace_back(parts[i]);
    for (std::size_t n = 1; n < taken[i]; ++n) name += "," + parts[i + n];
  }
  return names;
}

}  // namespace phos
