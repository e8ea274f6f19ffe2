// The statements of a material library, word by word: tinyobjloader does not tell which statements are
// absent, and drops those that it does not know.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"

namespace phos::inline scene {

/// The statements of one newmtl: keyword to the rest of its line. The last of several counts.
struct MtlStatements {
  std::string material;
  std::map<std::string, std::string> rest;

  bool states(const std::string& keyword) const { return rest.contains(keyword); }
  /// Does an option ("-halo") stand before the value of the statement?
  bool has_option(const std::string& keyword, const std::string& option) const;
  /// The options of a statement, each with its dash.
  std::vector<std::string> options(const std::string& keyword) const;
  /// The finite numbers of the statement, options before them left out; none where it is absent, or states
  /// something else ("spectral file.rfl").
  std::vector<double> numbers(const std::string& keyword) const;
  /// The first of them.
  std::optional<double> number(const std::string& keyword) const;
  /// Three of them, or one for all three channels; below 0 is 0. Nothing where there are none.
  std::optional<Rgb> colour(const std::string& keyword) const;
};

/// Of each newmtl, in the order of the file.
std::vector<MtlStatements> mtl_statements(std::string_view text);

/// What phos does with a statement of a material library.
enum class MtlUse {
  read,       ///< modelled, or, as Ka, a stand-in for light that phos computes
  not_read,   ///< known, but not modelled
  not_known,  ///< in no version of the format that phos knows
};
MtlUse mtl_use(const std::string& keyword);

}  // namespace phos::inline scene
