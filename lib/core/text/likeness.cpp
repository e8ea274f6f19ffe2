#include "core/text/likeness.h"

#include <algorithm>

#include "core/error.h"

namespace phos {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, changed});
    }
  }
  return row[b.size()];
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  const std::string* nearest = nullptr;
  const std::size_t letters = word.size() - std::min(word.size(), word.find_first_not_of('-'));
  std::size_t least = std::max<std::size_t>(2, letters / 2);  // half of them are no likeness
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(word, name);
    if (distance <= least && (!nearest || distance < least)) nearest = &name, least = distance;
  }
  return nearest ? text("; did you mean \"", *nearest, "\"?") : "";
}

}  // namespace phos
