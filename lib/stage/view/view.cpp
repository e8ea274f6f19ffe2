#include "stage/view/view.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "core/progress.h"
#include "file/atomic_file.h"
#include "scene/nested_glass.h"
#include "scene/report/unsampled.h"
#include "stage/inputs.h"
#include "stage/site.h"
#include "stage/view/cache_sets.h"
#include "stage/view/lit_scene.h"
#include "stage/view/static.h"
#include "view/drawing_notes.h"
#include "view/gloss_message.h"
#include "view/light_reader.h"
#include "view/message/reader.h"
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

/// The growing cache; nothing, with a note, where no cache can grow and nobody asks for it.
std::unique_ptr<WalkGrowth> growth_of(Tool& tool, const WalkFiles& paths, const LitSets& sets,
                                      const GrowthCommand& asked, std::vector<std::string>& notes) {
  if (asked.records_per_frame == 0) {
    if (asked.save.empty()) return nullptr;
    throw Error(ExitCode::usage, "--save", "needs new records; leave out --records-per-frame 0");
  }
  try {
    if (sets.size() > 1 || sets[0].size() > 1 || !sets[0][0].name.empty())
      throw Error(ExitCode::usage, "CACHE",
                  "caches with names, and two sets of caches, do not grow; give one set without names");
    const LitGroup& group = sets[0][0];
    return std::make_unique<WalkGrowth>(tool, paths, group.files, group.lit->rays, group.records, asked);
  } catch (const Error& e) {
    const bool wanted =
        !paths.photons.empty() || !asked.save.empty() || tool.options().given("records-per-frame");
    if (wanted || e.code() == ExitCode::interrupted) throw;
    notes.push_back(
        text("surfaces without a record stay so: ", e.where(), e.where().empty() ? "" : " ", e.what()));
    return nullptr;
  }
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
  take_photons(asked.caches, asked.growth.photons);
  CacheSet first = cache_set(asked.caches, "CACHE");
  if (!first.named()) {  // the scene may stand among them
    const InputFiles inputs = scene_and_others(asked.scene_path, first.paths());
    asked.scene_path = inputs.scene;
    std::vector<std::string> caches = inputs.phos;
    take_photons(caches, asked.growth.photons);
    first = cache_set(caches, "CACHE");
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
  require_static_options(tool, asked);
  if (!asked.growth.save.empty()) require_writable(asked.growth.save);
  asked.growth.allow_mismatch = asked.allow_mismatch;
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
  const bool is_static = !asked.static_path.empty();
  std::unique_ptr<WalkGrowth> growth;
  if (is_static && !asked.growth.photons.empty())
    throw Error(ExitCode::usage, asked.growth.photons,
                "is for new records, which a page without a server does not get; leave it out");
  if (!is_static)
    growth =
        growth_of(tool, {scene_path, asked_sets[0].paths(), asked.growth.photons}, sets, asked.growth, notes);
  TextureLimits most;
  if (is_static) most.side = static_cast<std::size_t>(asked.texture_size);
  SceneMessage drawn = scene_message(lit.scene, static_cast<int>(asked.lamp_places), most);
  if (is_static) notes.push_back(precision_note(lit.scene));
  if (const std::size_t n = drawn.reduced_textures; n > 0)
    notes.push_back(text(n, n == 1 ? " texture has" : " textures have",
                         " fewer texels in the page than in the scene",
                         is_static ? " (--texture-size)" : ""));
  Json facts = about(scene_path, notes, asked_sets, sets);
  if (growth) facts["growth"] = growth->facts();
  PageFiles page(std::move(drawn.bytes), std::move(records[0]), facts);
  for (std::size_t i = 1; i < records.size(); ++i) page.add(path_of("records", i), std::move(records[i]));
  for (std::size_t i = 0; i < gloss.size(); ++i) page.add(path_of("gloss", i), std::move(gloss[i]));
  for (const std::string& note : notes) tool.say(note);
  if (is_static) return write_static_page(tool, asked, lit.scene, page);

  ViewServer server(asked.address, {[&](std::string_view path) { return page.find(path); },
                                    [&](std::string_view message) {
                                      if (!growth) return reader.answer(message);
                                      if (states_kind(message, MessageKind::wish))
                                        return growth->answer(message);
                                      growth->refresh(sets[0][0].caches);
                                      return reader.answer(message);
                                    }});
  tool.say("open the address in a browser; Ctrl-C ends the walk");
  set_progress_mode(ProgressMode::never);  // of readings and new records
  if (growth) growth->start();
  std::printf("%s\n", server.url().c_str());
  std::fflush(stdout);
  server.run();
  if (growth) growth->finish();
}

}  // namespace phos::stage
