#include "stage/view/lit_scene.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "radiance/brdf/projection.h"
#include "scene/lamp/shine_only.h"
#include "splat/caches.h"
#include "stage/inputs.h"
#include "temporal/film/inputs.h"

namespace phos::stage {

LitScenes::LitScenes(std::string path, SceneOptions options)
    : path_(std::move(path)), options_(std::move(options)) {}

const LitScene& LitScenes::with(const std::string& lamps) {
  std::unique_ptr<const LitScene>& lit = of_lamps_[lamps];
  if (!lit) {
    SceneOptions options = options_;
    options.lamps = lamps;
    lit = std::make_unique<const LitScene>(load_scene(path_, options));
  }
  return *lit;
}

namespace {

/// The scene that a group's caches were made from. A file that names lamps which the scene lacks is of
/// another one.
const LitScene& scene_of(const CacheGroup& group, LitScenes& scenes, const std::string& scene_path) {
  try {
    return scenes.with(group.lamps);
  } catch (const Error& e) {
    if (e.code() != ExitCode::usage) throw;
    throw Error(ExitCode::mismatch, group.paths[0],
                text("made from another scene than ", scene_path, ": ", e.what()));
  }
}

/// The files that hold records.
std::vector<Container> of_records(const std::vector<Container>& files) {
  std::vector<Container> records;
  for (const Container& file : files)
    if (file.kind() != FileKind::brdf) records.push_back(file);
  return records;
}

}  // namespace

LitGroup lit_group(const CacheGroup& group, LitScenes& scenes, const std::string& scene_path,
                   bool allow_mismatch, Counters& counters) {
  std::vector<Container> files = open_caches(group.paths, CacheKinds::records_and_lobes);
  const LitScene& own = scenes.own();
  const LitScene& lit = scene_of(group, scenes, scene_path);
  require_together(files, scene_path, lit.scene, allow_mismatch);
  SplatCaches all = read_caches(files, lit.scene, !glossy_materials(lit.scene).empty());
  IrradianceCache records = std::move(all.irradiance);
  if (any_footprint(records.records)) {
    const auto shaped = std::find_if(files.begin(), files.end(),
                                     [](const Container& file) { return file.has("footprint_length"); });
    throw Error(ExitCode::usage, (shaped == files.end() ? files.front() : *shaped).path(),
                "has adaptive records, which the page does not draw; make the cache with --footprint circle");
  }
  if (records.records.empty())
    throw Error(ExitCode::usage, group.paths[0], "holds no record; make a cache with phos-irradiance");
  RenderOptions render;
  render.gloss_accuracy = reading_accuracy(all.radiance);
  PictureGloss gloss = gloss_of_picture(lit.rays, all, render, allow_mismatch, counters);
  SensorCaches caches = sensor_caches_at(of_records(files), lit.scene, &lit.rays);
  LitGroup read{group.name,
                lamps_named(own.scene, &lit == &own ? "" : group.lamps),
                &lit,
                {},
                {},
                std::move(caches),
                std::move(gloss),
                *render.gloss_accuracy};
  read.files = std::move(files), read.records = std::move(records);
  return read;
}

}  // namespace phos::stage
