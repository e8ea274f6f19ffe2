#include "study/spec/sections.h"

#include <algorithm>

#include "core/error.h"
#include "core/text/append_item.h"
#include "core/text/likeness.h"
#include "study/spec/stages.h"
#include "study/spec/tools.h"
#include "study/spec/values.h"

namespace phos::inline study {

namespace {

/// Why a section may not have an option that its program takes; "" if it may.
std::string not_here(const std::string& section, const std::string& option) {
  const auto is = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), option) != names.end();
  };
  if (option == "seed") return "is the study's: [study] seeds = [0, 1, 2]";
  if (option == "threads") return "is the study's: [study] threads = 4";
  if (is({"output", "stats", "progress", "quiet", "verbose", "reuse", "why", "misses", "gloss-misses",
          "summary", "bases"}))
    return "does not change the result, or writes a file; leave it out";
  if (is({"shard", "part"})) return "makes a part of a file; leave it out";
  if (section != "temporal" && option == "frames")
    return "makes a sequence; name one frame, [common] frame = 12";
  const bool picture = section == "splat" || section == "reference";
  if (picture && option == "camera") return "is the study's: [study] cameras = [\"eye\"]";
  if (picture && is({"width", "height"}))
    return "is the study's, one size for all pictures: [study] width = 400";
  if (is({"points"})) return "is the study's: [study] sensors = \"points.csv\"";
  if (section == "sense" && is({"grid", "mesh", "height", "margin", "up"}))
    return "makes its own points; [study] sensors names those of the reference too";
  if (section == "sense" && is({"exact", "direct-only"}))
    return "reads no cache, so no stage before it matters; leave it out";
  return "";
}

std::vector<std::string> names_of(const ToolOptions& tool, const std::string& section) {
  std::vector<std::string> names;
  for (const auto& [name, option] : tool.options)
    if (not_here(section, name).empty()) names.push_back(name);
  return names;
}

/// The option that a key names ("min_radius" is "min-radius").
const ToolOption& find_option(const StudyKeys& keys, const std::string& section, const std::string& key,
                              const ToolOptions& tool) {
  std::string name = key;
  std::replace(name.begin(), name.end(), '_', '-');
  const ToolOption* option = tool.find(name);
  if (!option) {
    const std::string guess = did_you_mean(name, names_of(tool, section));
    keys.refuse(key, text(tool.tool, " has no such option",
                          guess.empty() ? "; see " + tool.tool + " --help" : guess));
  }
  if (const std::string why = not_here(section, name); !why.empty()) keys.refuse(key, why);
  return *option;
}

std::vector<std::string> words_of(const StudyKeys& keys, const std::string& key, const ToolOption& option,
                                  const Json& value, StudyFile& study) {
  if (option.name == "camera" && value == Json("each")) return {"--camera", kEachCamera};
  std::vector<std::string> words = option_words(option, value, study.folder, keys.where(key));
  if (option.kind == "file") study.files.insert(words.back());
  return words;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& words) {
  to.insert(to.end(), words.begin(), words.end());
}

/// A value as a table's cell, as the program reads it.
std::string label_of(const std::vector<std::string>& words, const Json& value) {
  if (value.is_bool()) return value.as_bool() ? "true" : "false";
  return words.back() == kEachCamera ? "each" : words.back();
}

void read_stage(const TomlFile& file, const StageKind& kind, StudyFile& study, const CommandRunner& runner) {
  const ToolOptions tool = options_of(runner, kind.tool);
  StudyKeys keys(file, kind.section);
  study.sections.insert(kind.section);
  std::vector<std::string>& fixed = study.fixed[kind.section];
  for (const std::string& key : keys.rest()) {
    const ToolOption& option = find_option(keys, kind.section, key, tool);
    Factor factor{kind.section, option.name, {}, {}, keys.line(key)};
    for (const Json& value : values_of(option, *keys.take(key), keys.where(key))) {
      factor.words.push_back(words_of(keys, key, option, value, study));
      factor.labels.push_back(label_of(factor.words.back(), value));
    }
    if (factor.words.size() == 1)
      append(fixed, factor.words[0]);
    else
      study.factors.push_back(std::move(factor));
  }
}

/// Options that hold for every stage that takes them, and for the reference.
void read_common(const TomlFile& file, StudyFile& study, const CommandRunner& runner) {
  StudyKeys keys(file, "common");
  const std::vector<std::string> names = keys.rest();
  if (names.empty()) return;
  std::vector<std::pair<std::string, ToolOptions>> tools{{"reference", options_of(runner, "phos-reference")}};
  for (const std::string& section : study.sections)
    tools.emplace_back(section, options_of(runner, find_stage(section)->tool));
  for (const std::string& key : names) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', '-');
    const Json& value = *keys.take(key);
    if (value.is_array() || value.is_object())
      keys.refuse(key, "has one value for all; lists and ranges stand in a stage's own section");
    std::vector<std::string> all;
    bool taken = false;
    for (const auto& [section, tool] : tools) {
      append(all, names_of(tool, section));
      if (!tool.find(name)) continue;
      taken = true;
      append(section == "reference" ? study.reference : study.fixed[section],
             words_of(keys, key, find_option(keys, section, key, tool), value, study));
    }
    if (!taken) keys.refuse(key, "no program of this study has such an option" + did_you_mean(name, all));
  }
}

void require_known_sections(const TomlFile& file) {
  std::vector<std::string> known{"study", "reference", "common"};
  for (const StageKind& kind : stage_kinds()) known.emplace_back(kind.section);
  for (const auto& [section, value] : file.root.as_object()) {
    if (std::find(known.begin(), known.end(), section) != known.end()) continue;
    std::string all;
    for (const std::string& name : known) append_item(all, name);
    const std::string guess = did_you_mean(section, known);
    throw Error(ExitCode::usage, file.where(section),
                text("[", section, "] is unknown", guess.empty() ? "; there are: " + all : guess));
  }
}

}  // namespace

void read_sections(const TomlFile& file, StudyFile& study, const CommandRunner& runner) {
  require_known_sections(file);
  for (const StageKind& kind : stage_kinds())
    if (file.root.find(kind.section) || (study.reads_sensors() && std::string(kind.section) == "sense"))
      read_stage(file, kind, study, runner);
  read_common(file, study, runner);
  std::stable_sort(study.factors.begin(), study.factors.end(),
                   [](const Factor& a, const Factor& b) { return a.line < b.line; });
}

void read_reference_options(StudyKeys& keys, StudyFile& study, const CommandRunner& runner) {
  const ToolOptions tool = options_of(runner, "phos-reference");
  const std::vector<std::string> own = {"seeds", "files", "lux", "given", "sensor_samples"};
  for (const std::string& key : keys.rest()) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', '-');
    if (!tool.find(name))
      if (const std::string guess = did_you_mean(key, own); !guess.empty())
        keys.refuse(key, "is unknown" + guess);
    const ToolOption& option = find_option(keys, "reference", key, tool);
    const Json& value = *keys.take(key);
    if (value.is_array() || value.is_object())
      keys.refuse(key, "has one value: one reference judges all settings");
    append(study.reference, words_of(keys, key, option, value, study));
  }
}

}  // namespace phos::inline study
