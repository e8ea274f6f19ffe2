#include "file/kinds/shape_pattern.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/text/append_item.h"

namespace phos::inline file {

namespace {

/// One extent of a row's shape.
struct ExtentPattern {
  std::uint64_t number = 0;  ///< the extent, where it has no symbol
  std::string symbol;
  enum class Of { itself, plus_one, square } of = Of::itself;
  std::string_view names;  ///< names of three indices, "rgb" or "xyz"

  std::uint64_t from(std::uint64_t known) const {
    return of == Of::itself ? known : of == Of::plus_one ? known + 1 : known * known;
  }
  /// The symbol's value where this extent is n; nothing where no value gives n.
  std::optional<std::uint64_t> solved(std::uint64_t n) const {
    if (of == Of::itself) return n;
    if (of == Of::plus_one) return n > 0 ? std::optional(n - 1) : std::nullopt;
    const auto root = static_cast<std::uint64_t>(std::llround(std::sqrt(static_cast<double>(n))));
    return root * root == n ? std::optional(root) : std::nullopt;
  }
};

ExtentPattern parse(std::string_view word, std::string_view table) {
  ExtentPattern e;
  if (word == "rgb" || word == "xyz") {
    e.number = 3, e.names = word;
    return e;
  }
  const char* const end = word.data() + word.size();
  if (std::from_chars(word.data(), end, e.number).ptr == end) return e;
  using Of = ExtentPattern::Of;
  if (word.ends_with("+1")) e.of = Of::plus_one, word.remove_suffix(2);
  if (word.ends_with("^2")) e.of = Of::square, word.remove_suffix(2);
  e.symbol = word.starts_with("K.") ? std::string(table) + std::string(word.substr(1)) : std::string(word);
  return e;
}

std::vector<ExtentPattern> pattern_of(const TensorRow& row, std::string_view table) {
  std::vector<ExtentPattern> all;
  for (std::string_view rest = row.shape; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    all.push_back(parse(rest.substr(0, comma), table));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return all;
}

}  // namespace

std::string shape_words(const TensorRow& row) {
  std::string out;
  for (std::string_view rest = row.shape; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    std::string word(rest.substr(0, comma));
    if (word == "rgb" || word == "xyz") word.assign(1, '3');
    if (word.starts_with("K.")) word.erase(0, 2);
    if (word.ends_with("^2")) word.replace(word.size() - 2, 2, "²");
    append_item(out, word, ",");
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return text('[', out, ']');
}

std::string shape_words(const Shape& shape) {
  std::string out;
  for (const std::uint64_t n : shape) append_item(out, std::to_string(n), ",");
  return text('[', out, ']');
}

bool fits(const TensorRow& row, std::string_view table, const Shape& shape, Extents& known) {
  const std::vector<ExtentPattern> pattern = pattern_of(row, table);
  if (shape.size() != pattern.size()) return false;
  for (std::size_t d = 0; d < shape.size(); ++d) {
    const ExtentPattern& e = pattern[d];
    if (e.symbol.empty() ? shape[d] != e.number : !e.solved(shape[d])) return false;
    if (e.symbol.empty()) continue;
    const auto [found, first] = known.emplace(e.symbol, *e.solved(shape[d]));
    if (!first && e.from(found->second) != shape[d]) return false;
  }
  return true;
}

Shape shape_of(const TensorRow& row, std::string_view table, std::uint64_t numbers, Extents& known) {
  const std::vector<ExtentPattern> pattern = pattern_of(row, table);
  std::uint64_t others = 1;
  const ExtentPattern* unknown = nullptr;
  for (const ExtentPattern& e : pattern) {
    if (e.symbol.empty() || known.contains(e.symbol)) {
      others *= e.symbol.empty() ? e.number : e.from(known.at(e.symbol));
      continue;
    }
    PHOS_CHECK(!unknown && e.of == ExtentPattern::Of::itself, row.name, " has unknown extents");
    unknown = &e;
  }
  if (unknown) known[unknown->symbol] = others > 0 ? numbers / others : 0;
  Shape shape;
  for (const ExtentPattern& e : pattern)
    shape.push_back(e.symbol.empty() ? e.number : e.from(known.at(e.symbol)));
  return shape;
}

std::string index_name(const TensorRow& row, std::size_t dimension, std::uint64_t index) {
  const std::vector<ExtentPattern> pattern = pattern_of(row, "");
  const bool named = dimension < pattern.size() && !pattern[dimension].names.empty() && index < 3;
  return named ? std::string(1, pattern[dimension].names[index]) : std::to_string(index);
}

}  // namespace phos::inline file
