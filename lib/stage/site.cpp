#include "stage/site.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/text/comma_list.h"
#include "file/adoption.h"
#include "scene/load.h"
#include "scene/sky/daylight.h"

namespace phos::stage {
namespace {

/// Recorded values by the name of their option.
using Values = std::map<std::string, Json>;

bool is_stated(const Json* value) {
  if (!value || value->is_null()) return false;
  return !(value->is_string() && value->as_string().empty()) &&
         !(value->is_array() && value->as_array().empty());
}

const Json* recorded(const Container& file, const std::string& name) {
  const Json* value = file.provenance().parameters.find(name);
  return is_stated(value) ? value : nullptr;
}

template <class T>
std::vector<std::string> names_of() {
  Options options("", "", "");
  T values;
  declare_options(options, values);
  return options.names();
}

DaylightOptions daylight_of(const Values& values) {
  Options options("", "", "");
  DaylightOptions daylight;
  declare_options(options, daylight);
  for (const auto& [name, value] : values) options.adopt(name, value);
  return daylight;
}

/// Equal where the light is; nothing for values that do not go together.
std::optional<std::string> recipe_of(const Values& values) {
  try {
    return resolve(daylight_of(values)).recipe;
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Takes over option by option from one file after another.
class Site {
 public:
  Site(Options& options, bool allow_mismatch, LampsOf lamps)
      : options_(options), allow_mismatch_(allow_mismatch), lamps_(lamps) {
    for (std::string& name : options.names()) known_.insert(std::move(name));
    for (std::string& name : names_of<DaylightOptions>()) by_rule_.insert(std::move(name));
  }

  /// The line that lists the values taken; "" for none.
  std::string take(const Container& file) {
    taken_.clear();
    file_ = &file;
    take_daylight();
    take_environment();
    for (const std::string& name : options_.names(Adopted::site))
      if (!by_rule_.contains(name)) is_of_files(name) ? require_files(name) : take_one(name);
    take_portals();
    if (lamps_ == LampsOf::all_files) take_lamps();
    take_time();
    return taken_.empty() ? "" : text(taken_, ": as of ", file.path());
  }

 private:
  bool given(const std::string& name) const { return known_.contains(name) && options_.given(name); }
  const Json* was(const std::string& name) const { return recorded(*file_, name); }

  void take_one(const std::string& name) {
    const Json* value = was(name);
    if (!value || !known_.contains(name) || options_.given(name) || !settled_.insert(name).second) return;
    adopt_recorded(options_, name, *value, *file_);
    taken_ += text(taken_.empty() ? "" : ", ", name, " ", shown(*value));
  }

  void take_daylight() {
    Values then, asked, now;
    for (const std::string& name : names_of<DaylightOptions>()) {
      if (!known_.contains(name)) continue;
      if (const Json* value = was(name)) then[name] = *value;
      if (const Json value = options_.value(name); options_.given(name) && is_stated(&value))
        asked[name] = value;
    }
    if (given("environment")) {
      if (!then.empty())
        refuse(text("was made under ", words_of(then), ", not an environment map; leave --environment out"));
      return;
    }
    now = then;
    for (const auto& [name, value] : asked) now[name] = value;
    if (!asked.empty() && !agree(then, asked, now)) return;
    if (then.empty() || daylight_settled_) return;
    daylight_settled_ = true;
    for (const auto& [name, value] : then) take_one(name);
  }

  /// Is it the same light? Throws where it is not, and where that is not allowed.
  bool agree(const Values& then, const Values& asked, const Values& now) const {
    const std::optional<std::string> meant = recipe_of(now), was_meant = recipe_of(then);
    if (!meant && !recipe_of(asked)) return false;  // the command line is wrong, which is told elsewhere
    if (meant && was_meant && *meant == *was_meant) return true;
    if (then.empty()) {
      if (has_environment()) {
        refuse(text("was made under an environment map, not ", words_of(asked),
                    "; give the same --environment instead"));
        return false;
      }
      refuse(text("was made without --", asked.begin()->first, "; leave it out"));
      return false;
    }
    const std::string culprit = contradiction(then, asked, now, was_meant);
    const auto value = then.find(culprit);
    if (value != then.end())
      refuse(text("was made with --", culprit, " ", shown(value->second), ", not ", shown(asked.at(culprit)),
                  "; leave --", culprit, " out"));
    else
      refuse(text("was made with ", words_of(then), " and without --", culprit, " ", shown(asked.at(culprit)),
                  "; leave --", culprit, " out"));
    return false;
  }

  /// The option that alone makes the difference, or the first that differs.
  static std::string contradiction(const Values& then, const Values& asked, const Values& now,
                                   const std::optional<std::string>& was_meant) {
    std::string first;
    for (const bool stated : {true, false}) {
      for (const auto& [name, value] : asked) {
        const auto before = then.find(name);
        if ((before != then.end()) != stated || (stated && before->second.dump() == value.dump())) continue;
        if (first.empty()) first = name;
        Values without = now;
        if (stated)
          without[name] = before->second;
        else
          without.erase(name);
        if (recipe_of(without) == was_meant) return name;
      }
    }
    return first.empty() ? asked.begin()->first : first;
  }

  void take_environment() {
    const std::vector<std::string> daylight = names_of<DaylightOptions>();
    if (!has_environment() ||
        std::any_of(daylight.begin(), daylight.end(), [&](const std::string& name) { return was(name); }))
      return;
    if (given("environment")) {
      take_one("environment-rotation");
      take_one("environment-scale");
    } else if (std::none_of(daylight.begin(), daylight.end(),
                            [&](const std::string& name) { return given(name); })) {
      refuse("was made under an environment map, and its file is not recorded; give the same --environment");
    }
  }

  bool is_of_files(const std::string& name) const { return options_.value(name).is_array(); }

  /// Of NAME=FILE only names are recorded.
  void require_files(const std::string& option) const {
    const Json* names = was(option);
    if (!names || !names->is_array() || options_.given(option)) return;
    std::string words;
    for (const Json& name : names->as_array())
      if (name.is_string()) words += text(" --", option, " ", name.as_string(), "=FILE");
    refuse(text("was made with", words, ", and files are not recorded; give the same --", option));
  }

  /// They aim light that is the same without them: a file without portals contradicts none, and a command may
  /// do without (--portals "").
  void take_portals() {
    const Json* value = was("portals");
    const Json now = options_.value("portals");
    if (value && is_stated(&now) && given("portals") && shown(*value) != shown(now))
      refuse(text("was made with --portals ", shown(*value), ", not ", shown(now), "; leave --portals out"));
    if (sees_beyond()) take_one("portals");
  }

  /// Does the scene get light from infinity? Not of a map that --allow-mismatch leaves out.
  bool sees_beyond() const {
    if (given("environment")) return true;
    for (const std::string& name : names_of<DaylightOptions>())
      if (const Json value = options_.value(name); is_stated(&value)) return true;
    return false;
  }

  /// Lamps that shine are the same for all files, in any order of names.
  void take_lamps() {
    if (!known_.contains("lamps")) return;
    const Json* value = was("lamps");
    const Json now = options_.value("lamps");
    const std::string then_words = value ? shown(*value) : "", now_words = is_stated(&now) ? shown(now) : "";
    if ((given("lamps") || lamps_settled_) && sorted_names(then_words) != sorted_names(now_words))
      refuse(text("was made with ", lamps_in_words(then_words), ", not with ", lamps_in_words(now_words),
                  given("lamps") ? "; leave --lamps out" : "; give files of the same lamps"));
    lamps_settled_ = true;
    take_one("lamps");
  }

  static std::vector<std::string> sorted_names(const std::string& words) {
    std::vector<std::string> names = split_at_commas(words);
    std::sort(names.begin(), names.end());
    return names;
  }
  static std::string lamps_in_words(const std::string& words) {
    return words.empty() ? "all lamps" : "--lamps " + words;
  }

  void take_time() {
    const Json frames = options_.value("frames");
    if (is_stated(&frames) || given("time") || given("frame") || time_settled_) return;
    for (const char* name : {"time", "frame"})
      if (was(name) && known_.contains(name)) {
        time_settled_ = true;
        return take_one(name);
      }
  }

  bool has_environment() const { return is_stated(file_->provenance().scene_parts.find("environment")); }

  static std::string words_of(const Values& values) {
    std::string words;
    for (const auto& [name, value] : values)
      words += text(words.empty() ? "--" : " --", name, " ", shown(value));
    return words;
  }

  void refuse(const std::string& message) const {
    if (!allow_mismatch_) throw Error(ExitCode::mismatch, file_->path(), message);
  }

  Options& options_;
  bool allow_mismatch_;
  LampsOf lamps_;
  const Container* file_ = nullptr;
  std::set<std::string> known_, settled_;  // options of the program; those that a file has settled
  /// Options that are taken together with others, or not always.
  std::set<std::string> by_rule_{
      "environment-rotation", "environment-scale", "portals", "time", "frame", "lamps"};
  bool daylight_settled_ = false, time_settled_ = false, lamps_settled_ = false;
  std::string taken_;
};

}  // namespace

std::vector<std::string> adopt_site(Options& options, const std::vector<Container>& files,
                                    bool allow_mismatch, LampsOf lamps) {
  Site site(options, allow_mismatch, lamps);
  std::vector<std::string> lines;
  for (const Container& file : files)
    if (file.kind() != FileKind::brdf && !file.provenance().parameters.is_null())
      if (std::string line = site.take(file); !line.empty()) lines.push_back(std::move(line));
  return lines;
}

void take_site(Tool& tool, const std::vector<std::string>& paths, bool allow_mismatch, LampsOf lamps) {
  std::vector<Container> files;
  for (const std::string& path : paths)
    if (!path.empty() && is_container(path)) files.push_back(Container::open(path));
  for (const std::string& line : adopt_site(tool.options(), files, allow_mismatch, lamps)) tool.say(line);
}

}  // namespace phos::stage
