#include "study/spec/tools.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/text/append_item.h"
#include "core/text/likeness.h"
#include "file/json_parse.h"

namespace phos::inline study {

namespace {

ToolOption option_from(const Json& o) {
  ToolOption option{
      o.find("name")->as_string(), o.find("kind")->as_string(), o.find("unit")->as_string(), {}, {},
      *o.find("default")};
  if (const Json* choices = o.find("choices"))
    for (const Json& c : choices->as_array()) option.choices.push_back(c.as_string());
  if (const Json* min = o.find("min"))
    option.range.lo = min->as_number(), option.range.lo_open = o.find("min_excluded")->as_bool();
  if (const Json* max = o.find("max")) option.range.hi = max->as_number();
  return option;
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& w : words) append_item(all, w);
  return all;
}

std::string limits_of(const Range& range) {
  const bool lo = std::isfinite(range.lo), hi = std::isfinite(range.hi);
  return text(lo ? range.lo_open ? "above " : "at least " : "", lo ? shortest(range.lo) : "",
              lo && hi ? " and " : "", hi ? "at most " + shortest(range.hi) : "");
}

/// A number as an option takes it. A whole number may be written as 1e5.
std::string number_word(const ToolOption& option, const Json& value, const std::string& where) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::usage, where, text(option.name, " = ", value.dump(), why));
  };
  const bool whole = option.kind == "integer";
  if (!value.is_number() || !std::isfinite(value.as_number()))
    refuse(whole ? " is not a whole number" : " is not a number");
  const double v = value.as_number();
  if (v < option.range.lo || v > option.range.hi || (option.range.lo_open && v == option.range.lo))
    refuse(text(" is out of range; it must be ", limits_of(option.range)));
  if (!whole || value.is_integer()) return value.dump();
  constexpr double kExact = 9007199254740992;  // 2^53: up to there a double counts one by one
  if (v != std::floor(v) || std::fabs(v) > kExact) refuse(" is not a whole number");
  return std::to_string(static_cast<std::int64_t>(v));
}

std::string text_word(const ToolOption& option, const Json& value, const std::string& where) {
  if (value.is_string()) return value.as_string();
  if (value.is_number()) return value.dump();
  throw Error(ExitCode::usage, where,
              text(option.name, " = ", value.dump(), " is not a word; put it in quotes"));
}

}  // namespace

const ToolOption* ToolOptions::find(const std::string& name) const {
  const auto found = options.find(name);
  return found == options.end() ? nullptr : &found->second;
}

ToolOptions options_of(const CommandRunner& runner, const std::string& tool) {
  const Json all = parse_json(runner.require({tool, {"--options-json"}, ""}).out, tool + " --options-json");
  ToolOptions options{tool, {}};
  for (const Json& o : all.find("options")->as_array()) {
    const std::string kind = o.find("kind")->as_string();
    if (kind != "input" && kind != "inputs")
      options.options.emplace(o.find("name")->as_string(), option_from(o));
  }
  return options;
}

std::vector<std::string> option_words(const ToolOption& option, const Json& value, const std::string& folder,
                                      const std::string& where) {
  const std::string name = "--" + option.name;
  if (option.kind == "flag") {
    if (!value.is_bool())
      throw Error(
          ExitCode::usage, where,
          text(option.name, " = ", value.dump(), " is not true or false, and ", name, " is a switch"));
    return value.as_bool() ? std::vector{name} : std::vector<std::string>{};
  }
  if (option.kind == "number" || option.kind == "integer") return {name, number_word(option, value, where)};
  std::string word = text_word(option, value, where);
  if (option.kind == "choice" &&
      std::find(option.choices.begin(), option.choices.end(), word) == option.choices.end())
    throw Error(ExitCode::usage, where,
                text(option.name, " = \"", word, "\" is not one of: ", joined(option.choices),
                     did_you_mean(word, option.choices)));
  if (option.kind == "file" && !word.empty()) {
    word = (std::filesystem::path(folder) / word).lexically_normal().string();
    std::error_code too_long;
    if (!std::filesystem::exists(word, too_long))
      throw Error(ExitCode::bad_input, where, text(option.name, ": there is no file ", word));
  }
  return {name, word};
}

}  // namespace phos::inline study
