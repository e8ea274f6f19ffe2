#include "stage/view/view.h"

#include <cstdio>
#include <filesystem>

#include "core/progress.h"
#include "scene/material/bsdf.h"
#include "scene/nested_glass.h"
#include "scene/rays.h"
#include "scene/report/unsampled.h"
#include "sense/sensors.h"
#include "splat/caches.h"
#include "stage/inputs.h"
#include "stage/site.h"
#include "stage/view/static.h"
#include "temporal/film/inputs.h"
#include "view/light_reader.h"
#include "view/page_files.h"
#include "view/records_message.h"
#include "view/scene_message.h"

namespace phos::stage {
namespace {

/// Approximations of the drawing, for the page and the terminal. Readings under the cursor have none of them.
std::vector<std::string> notes_of(const Scene& scene, const RayScene& rays, const IrradianceCache& cache) {
  std::vector<std::string> notes;
  bool gloss = false, bumps = false;
  for (std::uint32_t i = 0; i < scene.material.size(); ++i) {
    const Bsdf bsdf(scene, i);
    gloss = gloss || bsdf.has_gloss() || bsdf.has_specular();
    bumps = bumps || scene.material[i].normal.used();
  }
  if (gloss) notes.push_back("gloss and mirrors are drawn as matt surfaces of their mean reflectance");
  if (rays.has_panes()) notes.push_back("glass is not drawn, and takes no light away");
  if (bumps) notes.push_back("normal maps are not drawn");
  if (cache.caustics) notes.push_back("caustic light, which the cache holds as photons, is not drawn");
  return notes;
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
  require_static_options(tool, asked);
  const InputFiles inputs = scene_and_others(asked.scene_path, asked.caches);
  take_site(tool, inputs.phos, asked.allow_mismatch);
  tool.add_input("scene", scene_files(inputs.scene, asked.scene));
  const std::vector<Container> files = open_caches(inputs.phos, CacheKinds::records);
  const Scene scene = load_scene(inputs.scene, asked.scene);
  tell_losses(tool, scene);
  require_together(files, inputs.scene, scene, asked.allow_mismatch);
  tell_unsampled_in(tool, files);
  const IrradianceCache cache = read_caches(files, scene).irradiance;
  if (any_footprint(cache.records))
    throw Error(ExitCode::usage, inputs.phos[0],
                "has adaptive records, which the page does not draw; make the cache with --footprint circle");
  if (cache.records.empty())
    throw Error(ExitCode::usage, inputs.phos[0], "holds no record; make a cache with phos-irradiance");
  const RayScene rays(scene);
  const Luminaires lights(scene);
  if (const auto nested = nested_glass(rays)) tool.warn(*nested);
  const SensorCaches caches = sensor_caches_at(files, scene, &rays);
  SensorOptions sense;
  sense.seed = tool.seed();
  const LightReader reader(rays, lights, caches, sense);
  std::vector<std::string> notes = notes_of(scene, rays, cache);
  std::string drawn = scene_message(scene, static_cast<int>(asked.lamp_places));
  const bool is_static = !asked.static_path.empty();
  if (is_static) drawn = message_for_static_page(std::move(drawn), asked, scene, notes);
  const PageFiles page(std::move(drawn),
                       records_message(cache, asked.accuracy.value_or(reading_accuracy(cache.accuracy))),
                       about(inputs.scene, notes));
  for (const std::string& note : notes) tool.say(note);
  if (is_static) return write_static_page(tool, asked, scene, page);

  ViewServer server(asked.address, {[&](std::string_view path) { return page.find(path); },
                                    [&](std::string_view message) { return reader.answer(message); }});
  tool.say("open the address in a browser; Ctrl-C ends the walk");
  set_progress_mode(ProgressMode::never);  // of readings
  std::printf("%s\n", server.url().c_str());
  std::fflush(stdout);
  server.run();
}

}  // namespace phos::stage
