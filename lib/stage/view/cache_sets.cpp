#include "stage/view/cache_sets.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "core/error.h"
#include "core/text/likeness.h"
#include "core/text/named_files.h"
#include "file/adoption.h"
#include "file/container.h"
#include "scene/lamp/shine_only.h"

namespace phos::stage {
namespace {

std::vector<NamedFile> files_of(const std::string& word, const std::string& where) {
  std::error_code ignored;
  if (word.find('=') == std::string::npos || std::filesystem::exists(word, ignored)) return {{"", word}};
  return named_files({word}, where);
}

void add(CacheSet& set, const NamedFile& file) {
  const auto same = std::find_if(set.groups.begin(), set.groups.end(),
                                 [&](const CacheGroup& group) { return group.name == file.name; });
  if (same == set.groups.end()) {
    set.groups.push_back({file.name, {file.file}, ""});
    return;
  }
  if (!file.name.empty())
    for (const std::string& path : same->paths)
      if (Container::open(path).kind() == Container::open(file.file).kind())
        throw Error(ExitCode::usage, file.file,
                    text("is a second cache of the group \"", file.name, "\" beside ", path,
                         "; give it another name, or leave one out"));
  same->paths.push_back(file.file);
}

std::vector<std::string> names_of(const CacheSet& set) {
  std::vector<std::string> names;
  for (const CacheGroup& group : set.groups) names.push_back(group.name);
  return names;
}

void require_known(const CacheSet& set, const CacheSet& other, const char* remedy) {
  const std::vector<std::string> known = names_of(other);
  for (const std::string& name : names_of(set))
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error(ExitCode::usage, "--compare",
                  text(remedy, " \"", name, "\"", did_you_mean(name, known),
                       "; both sets need the same groups, or one set no names"));
}

std::string words_of(const std::string& lamps) { return lamps.empty() ? "all lamps" : "--lamps " + lamps; }

}  // namespace

std::vector<std::string> CacheSet::paths() const {
  std::vector<std::string> all;
  for (const CacheGroup& group : groups) all.insert(all.end(), group.paths.begin(), group.paths.end());
  return all;
}

CacheSet cache_set(const std::vector<std::string>& words, const std::string& where) {
  CacheSet set;
  for (const std::string& word : words)
    for (const NamedFile& file : files_of(word, where)) {
      add(set, file);
      if (set.groups.front().name.empty() != file.name.empty())
        throw Error(ExitCode::usage, file.name.empty() ? file.file : set.groups.front().paths.front(),
                    text("has no name, and other caches have; give NAME=", "FILE for each"));
    }
  return set;
}

void require_same_groups(const CacheSet& shown, const CacheSet& compared) {
  if (!shown.named() || !compared.named()) return;
  require_known(compared, shown, "the first set has no group");
  require_known(shown, compared, "lacks the group");
}

void read_lamps(CacheSet& set) {
  for (CacheGroup& group : set.groups) {
    const std::string* first = nullptr;
    for (const std::string& path : group.paths) {
      const Container file = Container::open(path);
      if (file.kind() == FileKind::brdf) continue;  // lobes know no lamps
      const Json* recorded = file.provenance().parameters.find("lamps");
      const std::string lamps = recorded ? shown(*recorded) : "";
      if (first && lamps != group.lamps)
        throw Error(ExitCode::mismatch, path,
                    text("was made with ", words_of(lamps), ", and ", *first, " with ", words_of(group.lamps),
                         "; give each group of lamps a name: NAME=FILE"));
      group.lamps = lamps, first = &path;
    }
  }
}

std::vector<std::string> require_apart(const CacheSet& set, const Scene& scene) {
  std::map<std::uint32_t, std::string> group_of;
  for (const CacheGroup& group : set.groups) {
    if (group.lamps.empty() && set.groups.size() > 1)
      throw Error(ExitCode::usage, group.paths.front(),
                  text("holds the light of all lamps, and \"", group.name,
                       "\" is one of several groups; make its photons with --lamps NAMES"));
    for (const std::uint32_t lamp : lamps_named(scene, group.lamps))
      if (const auto [other, first] = group_of.emplace(lamp, group.name);
          !first && other->second != group.name)
        throw Error(ExitCode::usage, group.paths.front(),
                    text("holds the light of the lamp \"", scene.light[lamp].name, "\", which the group \"",
                         other->second, "\" holds too; its light would count twice"));
  }
  std::vector<std::string> dark;
  for (std::uint32_t i = 0; i < scene.light.size(); ++i)
    if (!group_of.contains(i) && std::find(dark.begin(), dark.end(), scene.light[i].name) == dark.end())
      dark.push_back(scene.light[i].name);
  return dark;
}

}  // namespace phos::stage
