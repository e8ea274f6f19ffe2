#include "scene/obj/mtl_statements.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>

namespace phos::inline scene {

namespace {

bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0;
}

std::optional<double> number_of(const std::string& word) {
  const char* begin = word.data() + (word.front() == '+' ? 1 : 0);
  double value = 0;
  const auto [end, problem] = std::from_chars(begin, word.data() + word.size(), value);
  if (problem != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace

std::vector<std::string> MtlStatements::options(const std::string& keyword) const {
  std::vector<std::string> found;
  const auto at = rest.find(keyword);
  if (at == rest.end()) return found;
  std::istringstream words(at->second);
  for (std::string word; words >> word;)
    if (is_option(word)) found.push_back(word);
  return found;
}

bool MtlStatements::has_option(const std::string& keyword, const std::string& option) const {
  const std::vector<std::string> all = options(keyword);
  return std::find(all.begin(), all.end(), option) != all.end();
}

std::vector<double> MtlStatements::numbers(const std::string& keyword) const {
  std::vector<double> found;
  const auto at = rest.find(keyword);
  if (at == rest.end()) return found;
  std::istringstream words(at->second);
  for (std::string word; words >> word;) {
    if (found.empty() && is_option(word)) continue;
    const std::optional<double> value = number_of(word);
    if (!value) break;
    found.push_back(*value);
  }
  return found;
}

std::optional<double> MtlStatements::number(const std::string& keyword) const {
  const std::vector<double> all = numbers(keyword);
  return all.empty() ? std::nullopt : std::optional(all.front());
}

std::optional<Rgb> MtlStatements::colour(const std::string& keyword) const {
  const std::vector<double> all = numbers(keyword);
  if (all.empty()) return std::nullopt;
  Rgb c;
  for (std::size_t k = 0; k < 3; ++k)
    c[static_cast<int>(k)] = std::max(0.0f, static_cast<float>(all[std::min(k, all.size() - 1)]));
  return c;
}

std::vector<MtlStatements> mtl_statements(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  std::vector<MtlStatements> all;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\n\r"), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
    line = line.substr(0, line.find_last_not_of(kBlank) + 1);
    const std::string keyword(line.substr(0, line.find_first_of(kBlank)));
    line.remove_prefix(keyword.size());
    line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
    if (keyword.empty() || keyword.front() == '#') continue;
    if (keyword == "newmtl") {
      if (!line.empty()) all.push_back({std::string(line), {}});
    } else if (!all.empty()) {
      all.back().rest[keyword] = std::string(line);
    }
  }
  return all;
}

MtlUse mtl_use(const std::string& keyword) {
  static const std::set<std::string> kRead = {"Ka",     "Kd",     "Ks",    "Ke",  "Ns",     "Ni",
                                              "d",      "Tr",     "Tf",    "Kt",  "map_Ka", "illum",
                                              "map_Kd", "map_Ke", "map_d", "norm"};
  static const std::set<std::string> kNotRead = {
      "map_Ks",   "map_Ns",   "map_Tf", "map_aat", "map_bump",  "map_Bump", "bump",  "disp",
      "map_disp", "map_Disp", "decal",  "refl",    "sharpness", "Pr",       "Pm",    "Ps",
      "Pc",       "Pcr",      "aniso",  "anisor",  "map_Pr",    "map_Pm",   "map_Ps"};
  if (kRead.contains(keyword)) return MtlUse::read;
  return kNotRead.contains(keyword) ? MtlUse::not_read : MtlUse::not_known;
}

}  // namespace phos::inline scene
