#include "study/study_toml.h"

#include <toml++/toml.h>

#include <algorithm>

#include "core/error.h"

namespace phos {

namespace {

Json to_json(const toml::node& node, const std::string& path);

Json to_json(const toml::array& array, const std::string& path) {
  Json all = Json::Array{};
  for (const toml::node& item : array) all.push_back(to_json(item, path));
  return all;
}

Json to_json(const toml::table& table, const std::string& path) {
  Json all = Json::Object{};
  for (const auto& [key, value] : table) all[std::string(key.str())] = to_json(value, path);
  return all;
}

Json to_json(const toml::node& node, const std::string& path) {
  if (const toml::table* table = node.as_table()) return to_json(*table, path);
  if (const toml::array* array = node.as_array()) return to_json(*array, path);
  if (const auto* v = node.as_string()) return v->get();
  if (const auto* v = node.as_integer()) return v->get();
  if (const auto* v = node.as_floating_point()) return v->get();
  if (const auto* v = node.as_boolean()) return v->get();
  throw Error(ExitCode::bad_input, text(path, ":", node.source().begin.line),
              "is a date or a time, which nothing here takes; put it in quotes if it is a word");
}

std::string one_line(std::string s) {
  for (char& c : s)
    if (c == '\n') c = ' ';
  return s;
}

/// Where a string or a comment that begins at s[i] ends.
std::size_t end_of_text(std::string_view s, std::size_t i) {
  const char mark = s[i];
  if (mark == '#') return std::min(s.find('\n', i), s.size());
  const std::string three(3, mark);
  const bool many_lines = s.substr(i, 3) == three;
  for (i += many_lines ? 3 : 1; i < s.size(); ++i) {
    if (mark == '"' && s[i] == '\\') {
      ++i;
    } else if (many_lines ? s.substr(i, 3) == three : s[i] == mark || s[i] == '\n') {
      return i + (many_lines ? 3 : 1);
    }
  }
  return s.size();
}

/// Each dot of a key makes a table in a table, for which the parser has no limit, and whoever walks through
/// them has a stack that ends. Brackets it counts itself.
void check_depth_of_keys(std::string_view s, const std::string& path) {
  constexpr std::size_t kMostDots = 16;
  std::size_t dots = 0, line = 1;
  for (std::size_t i = 0; i < s.size();) {
    if (s[i] == '"' || s[i] == '\'' || s[i] == '#') {
      const std::size_t end = end_of_text(s, i);
      line += static_cast<std::size_t>(std::count(s.begin() + static_cast<std::ptrdiff_t>(i),
                                                  s.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      i = end;
      continue;
    }
    if (s[i] == '\n') ++line;
    const bool ends_key = std::string_view("\n=,[]{}").find(s[i]) != std::string_view::npos;
    if (ends_key) dots = 0;
    if (s[i] == '.' && ++dots > kMostDots)
      throw Error(ExitCode::bad_input, text(path, ":", line),
                  text("has a key of more than ", kMostDots, " dots; nothing here has so many parts"));
    ++i;
  }
}

}  // namespace

std::string TomlFile::where(const std::string& name) const {
  const auto found = line.find(name);
  return found == line.end() ? path : text(path, ":", found->second);
}

TomlFile parse_toml(std::string_view text_of_file, const std::string& path) {
  TomlFile file;
  file.path = path;
  check_depth_of_keys(text_of_file, path);
  try {
    const toml::table table = toml::parse(text_of_file, path);
    file.root = to_json(table, path);
    for (const auto& [key, value] : table) {
      const std::string section(key.str());
      file.line[section] = key.source().begin.line;
      if (const toml::table* inner = value.as_table())
        for (const auto& [name, unused] : *inner)
          file.line[section + "." + std::string(name.str())] = name.source().begin.line;
    }
  } catch (const toml::parse_error& e) {
    throw Error(ExitCode::bad_input, phos::text(path, ":", e.source().begin.line),
                phos::text("is no TOML: ", one_line(std::string(e.description()))));
  }
  return file;
}

}  // namespace phos
