#include "stage/view/view.h"

#include <cstdio>
#include <filesystem>

#include "core/progress.h"
#include "radiance/brdf/file.h"
#include "radiance/brdf/projection.h"
#include "scene/nested_glass.h"
#include "scene/rays.h"
#include "scene/report/unsampled.h"
#include "sense/sensors.h"
#include "splat/caches.h"
#include "splat/picture/gloss.h"
#include "stage/inputs.h"
#include "stage/site.h"
#include "temporal/film/inputs.h"
#include "view/drawing_notes.h"
#include "view/gloss_message.h"
#include "view/light_reader.h"
#include "view/page_files.h"
#include "view/records_message.h"
#include "view/scene_message.h"

namespace phos::stage {
namespace {

/// The files that hold records.
std::vector<Container> of_records(const std::vector<Container>& files) {
  std::vector<Container> records;
  for (const Container& file : files)
    if (file.kind() != FileKind::brdf) records.push_back(file);
  return records;
}

Json about(const std::string& scene_path, const std::vector<std::string>& notes) {
  Json list = Json::Array{};
  for (const std::string& note : notes) list.push_back(note);
  Json facts = Json::Object{};
  facts["title"] = std::filesystem::path(scene_path).filename().string();
  facts["notes"] = list;
  return facts;
}

}  // namespace

void run(Tool& tool, ViewCommand& asked) {
  const InputFiles inputs = scene_and_others(asked.scene_path, asked.caches);
  take_site(tool, inputs.phos, asked.allow_mismatch);
  tool.add_input("scene", scene_files(inputs.scene, asked.scene));
  const std::vector<Container> files = open_caches(inputs.phos, CacheKinds::records_and_lobes);
  const Scene scene = load_scene(inputs.scene, asked.scene);
  tell_losses(tool, scene);
  require_together(files, inputs.scene, scene, asked.allow_mismatch);
  tell_unsampled_in(tool, files);
  SplatCaches read = read_caches(files, scene, !glossy_materials(scene).empty());
  const IrradianceCache& cache = read.irradiance;
  if (any_footprint(cache.records))
    throw Error(ExitCode::usage, inputs.phos[0],
                "has adaptive records, which the page does not draw; make the cache with --footprint circle");
  if (cache.records.empty())
    throw Error(ExitCode::usage, inputs.phos[0], "holds no record; make a cache with phos-irradiance");
  const RayScene rays(scene);
  const Luminaires lights(scene);
  if (const auto nested = nested_glass(rays)) tool.warn(*nested);
  const SensorCaches caches = sensor_caches_at(of_records(files), scene, &rays);
  RenderOptions render;
  render.gloss_accuracy = reading_accuracy(read.radiance);
  const PictureGloss gloss = gloss_of_picture(rays, read, render, asked.allow_mismatch, tool.counters());
  const GlossCache* records = gloss.cache ? &*gloss.cache : nullptr;
  SensorOptions sense;
  sense.seed = tool.seed();
  const LightReader reader(rays, lights, caches, sense);
  const std::vector<std::string> notes = drawing_notes(rays, cache, records);
  PageFiles page(scene_message(scene, static_cast<int>(asked.lamp_places)),
                 records_message(cache, asked.accuracy.value_or(reading_accuracy(cache.accuracy))),
                 about(inputs.scene, notes));
  page.add_message("/gloss.bin", gloss_message(scene, records, *render.gloss_accuracy));

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
