// TOML as JSON, with the lines where things stand.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "core/json.h"

namespace phos::inline study {

struct TomlFile {
  Json root;                                ///< an object
  std::map<std::string, std::size_t> line;  ///< of "section" and "section.key", from 1
  /// "study.toml:12", for messages; the file alone where a name has no line.
  std::string where(const std::string& name) const;
  std::string path;
};

/// TOML 1.0. Throws Error(bad_input) with the line at fault, for dates and times too, which mean nothing
/// here.
TomlFile parse_toml(std::string_view text, const std::string& path);

}  // namespace phos::inline study
