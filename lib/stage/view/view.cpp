#include "stage/view/view.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "core/progress.h"
#include "scene/nested_glass.h"
#include "scene/report/unsampled.h"
#include "stage/inputs.h"
#include "stage/site.h"
#include "stage/view/cache_sets.h"
#include "stage/view/lit_scene.h"
#include "view/drawing_notes.h"
#include "view/gloss_message.h"
#include "view/light_reader.h"
#include "view/page_files.h"
#include "view/records_message.h"
#include "view/scene_message.h"

namespace phos::stage {
namespace {

/// The groups of each set, read.
using LitSets = std::vector<std::vector<LitGroup>>;

/// The notes of all groups, each once.
std::vector<std::string> notes_of(const LitScene& lit, const LitSets& sets) {
  std::vector<std::string> notes;
  for (const std::vector<LitGroup>& set : sets)
    for (const LitGroup& group : set)
      for (const std::string& note : drawing_notes(lit.rays, group.records, group.radiance()))
        if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  return notes;
}

std::string list_of(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "\"" : ", \"") + name + "\"";
  return all;
}

/// Of the groups of all sets, one after another. `kind`: records or gloss.
std::string path_of(const char* kind, std::size_t number) {
  return number == 0 ? text("/", kind, ".bin") : text("/", kind, "-", number, ".bin");
}

/// {"label":FILES,"groups":[{"name":NAME,"lamps":[...],"records":PATH,"gloss":PATH},...]}
Json about(const CacheSet& asked, const std::vector<LitGroup>& set, std::size_t& number) {
  Json groups = Json::Array{};
  for (const LitGroup& group : set) {
    Json lamps = Json::Array{};
    for (const std::uint32_t lamp : group.lamps) lamps.push_back(static_cast<double>(lamp));
    Json row = Json::Object{};
    row["name"] = group.name, row["lamps"] = lamps;
    row["records"] = path_of("records", number), row["gloss"] = path_of("gloss", number);
    ++number;
    groups.push_back(row);
  }
  std::string label;
  for (const std::string& path : asked.paths())
    label += (label.empty() ? "" : ", ") + std::filesystem::path(path).filename().string();
  Json facts = Json::Object{};
  facts["label"] = label, facts["groups"] = groups;
  return facts;
}

Json about(const std::string& scene_path, const std::vector<std::string>& notes,
           const std::vector<CacheSet>& asked, const LitSets& sets) {
  Json list = Json::Array{};
  for (const std::string& note : notes) list.push_back(note);
  Json of_sets = Json::Array{};
  std::size_t number = 0;
  for (std::size_t i = 0; i < sets.size(); ++i) of_sets.push_back(about(asked[i], sets[i], number));
  Json facts = Json::Object{};
  facts["title"] = std::filesystem::path(scene_path).filename().string();
  facts["notes"] = list, facts["sets"] = of_sets;
  return facts;
}

/// The caches of the command line: the set that is shown, and the set to compare it with, if any.
std::vector<CacheSet> sets_of(ViewCommand& asked) {
  CacheSet first = cache_set(asked.caches, "CACHE");
  if (!first.named()) {  // the scene may stand among them
    const InputFiles inputs = scene_and_others(asked.scene_path, first.paths());
    asked.scene_path = inputs.scene;
    first = cache_set(inputs.phos, "CACHE");
  }
  std::vector<CacheSet> sets{std::move(first)};
  if (!asked.compare.empty()) {
    sets.push_back(cache_set(asked.compare, "--compare"));
    require_same_groups(sets[0], sets[1]);
  }
  return sets;
}

/// Takes the surroundings from the caches, and the lamps of each group.
void take_surroundings(Tool& tool, const ViewCommand& asked, std::vector<CacheSet>& sets) {
  std::vector<std::string> paths;
  bool named = false;
  for (const CacheSet& set : sets) {
    for (const std::string& path : set.paths()) paths.push_back(path);
    named = named || set.named();
  }
  if (named && tool.options().given("lamps"))
    throw Error(ExitCode::usage, "--lamps",
                "contradicts named caches, each of which states its lamps; leave it out");
  take_site(tool, paths, asked.allow_mismatch, named ? LampsOf::each_file : LampsOf::all_files);
  for (CacheSet& set : sets)
    if (named)
      read_lamps(set);
    else
      set.groups[0].lamps = asked.scene.lamps;
}

}  // namespace

void run(Tool& tool, ViewCommand& asked) {
  std::vector<CacheSet> asked_sets = sets_of(asked);
  const std::string& scene_path = asked.scene_path;
  take_surroundings(tool, asked, asked_sets);
  tool.add_input("scene", scene_files(scene_path, asked.scene));
  for (const CacheSet& set : asked_sets) open_caches(set.paths(), CacheKinds::records_and_lobes);
  LitScenes scenes(scene_path, asked.scene);
  const LitScene& lit = scenes.own();
  tell_losses(tool, lit.scene);
  LitSets sets;
  std::vector<std::string> records, gloss, notes;
  std::vector<GroupLights> lights;
  for (const CacheSet& set : asked_sets) {
    std::vector<LitGroup> groups;
    for (const CacheGroup& group : set.groups) {
      groups.push_back(lit_group(group, scenes, scene_path, asked.allow_mismatch, tool.counters()));
      tell_unsampled_in(tool, groups.back().files);
    }
    sets.push_back(std::move(groups));
    if (const auto dark = require_apart(set, lit.scene); !dark.empty())
      notes.push_back(text("lamps without a cache are dark: ", list_of(dark)));
  }
  if (const auto nested = nested_glass(lit.rays)) tool.warn(*nested);
  for (const std::string& note : notes_of(lit, sets)) notes.push_back(note);
  SensorOptions sense;
  sense.seed = tool.seed();
  for (const std::vector<LitGroup>& set : sets) {
    GroupLights& of_set = lights.emplace_back();
    for (const LitGroup& group : set) {
      of_set.push_back({group.lit->rays, group.lit->lights, group.caches});
      records.push_back(
          records_message(group.records, asked.accuracy.value_or(reading_accuracy(group.records.accuracy))));
      gloss.push_back(gloss_message(lit.scene, group.radiance(), group.gloss_accuracy));
    }
  }
  const LightReader reader(lights, sense);
  PageFiles page(scene_message(lit.scene, static_cast<int>(asked.lamp_places)), std::move(records[0]),
                 about(scene_path, notes, asked_sets, sets));
  for (std::size_t i = 1; i < records.size(); ++i) page.add(path_of("records", i), std::move(records[i]));
  for (std::size_t i = 0; i < gloss.size(); ++i) page.add(path_of("gloss", i), std::move(gloss[i]));

  ViewServer server(asked.address, {[&](std::string_view path) { return page.find(path); },
                                    [&](std::string_view message) { return reader.answer(message); }});
  for (const std::string& note : notes) tool.say(note);
  tool.say("open the address in a browser; Ctrl-C ends the walk");
  set_progress_mode(ProgressMode::never);  // of readings
  std::printf("%s\n", server.url().c_str());
  std::fflush(stdout);
  server.run();
}

}  // namespace phos::stage
