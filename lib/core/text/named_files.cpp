#include "core/text/named_files.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>

#include "core/error.h"
#include "core/text/comma_list.h"

namespace phos {
namespace {

constexpr std::size_t kNone = std::string_view::npos;
/// Ways to end a name or a file that are tried; more commas or "=" in one is a mistake.
constexpr int kMostTried = 32;

/// One NAME=FILE within words: where its "=" stands, and where it ends.
struct Parts {
  std::size_t equals = 0, end = 0;
};

bool is_there(std::string_view file) {
  std::error_code ignored;
  return !file.empty() && std::filesystem::exists(without_escapes(file), ignored);
}

/// Do words hold NAME=FILE?
bool has_form(std::string_view words) {
  const std::size_t equals = find_separator(words, '=');
  return equals != kNone && equals > 0 && equals + 1 < words.size();
}

/// Ends that a file may have which begins at `begin`: commas before another NAME=FILE, and the end.
std::vector<std::size_t> ends(std::string_view words, std::size_t begin) {
  std::vector<std::size_t> out;
  for (std::size_t comma = find_separator(words, ',', begin); comma != kNone && out.size() < kMostTried;
       comma = find_separator(words, ',', comma + 1))
    if (has_form(words.substr(comma + 1))) out.push_back(comma);
  out.push_back(words.size());
  return out;
}

/// A file that exists decides. A name that holds "=" holds no comma after it, or the word before that comma
/// would be a NAME=FILE itself.
std::optional<Parts> with_a_file(std::string_view words, std::size_t first) {
  const std::size_t comma = std::min(find_separator(words, ',', first), words.size());
  int tried = 0;
  for (std::size_t equals = first; equals < comma && tried++ < kMostTried;
       equals = find_separator(words, '=', equals + 1))
    for (const std::size_t end : ends(words, equals + 1))
      if (is_there(words.substr(equals + 1, end - equals - 1))) return Parts{equals, end};
  return std::nullopt;
}

/// As the form alone says: a comma ends the file if NAME=FILE follows before the next one.
Parts by_form(std::string_view words, std::size_t first) {
  for (std::size_t comma = find_separator(words, ',', first); comma != kNone;) {
    const std::size_t next = find_separator(words, ',', comma + 1);
    if (has_form(words.substr(comma + 1, std::min(next, words.size()) - comma - 1))) return {first, comma};
    comma = next;
  }
  return {first, words.size()};
}

/// The first NAME=FILE of words; nothing if they are not of that form.
std::optional<Parts> first_of(std::string_view words) {
  const std::size_t first = find_separator(words, '=');
  if (first == kNone || first == 0) return std::nullopt;
  const Parts parts = with_a_file(words, first).value_or(by_form(words, first));
  if (parts.end == parts.equals + 1) return std::nullopt;
  return parts;
}

}  // namespace

std::vector<std::string> split_named_files(const std::string& word) {
  std::vector<std::string> out;
  std::string_view rest = word;
  while (true) {
    const std::optional<Parts> parts = first_of(rest);
    const std::size_t end = parts ? parts->end : rest.size();
    out.emplace_back(rest.substr(0, end));
    if (end == rest.size()) return out;
    rest.remove_prefix(end + 1);
  }
}

std::string name_of(const std::string& word) {
  const std::optional<Parts> parts = first_of(word);
  return parts ? without_escapes(std::string_view(word).substr(0, parts->equals)) : word;
}

std::vector<NamedFile> named_files(const std::vector<std::string>& words, const std::string& option) {
  std::vector<NamedFile> out;
  for (const std::string& several : words) {
    for (const std::string& word : split_named_files(several)) {
      const std::optional<Parts> parts = first_of(word);
      if (!parts) throw Error(ExitCode::usage, option, text("\"", word, "\" is not of the form NAME=FILE"));
      const std::string_view w = word;
      out.push_back({without_escapes(w.substr(0, parts->equals)),
                     without_escapes(w.substr(parts->equals + 1, parts->end - parts->equals - 1))});
    }
  }
  return out;
}

}  // namespace phos
