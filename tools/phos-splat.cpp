// phos-splat: scene + caches -> OpenEXR picture.
#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "file/container.h"
#include "file/tool.h"
#include "image/image.h"
#include "image/image_provenance.h"
#include "image/without_errors.h"
#include "scene/inside_solid.h"
#include "scene/load.h"
#include "scene/motion/film.h"
#include "scene/rays.h"
#include "scene/report/unsampled.h"
#include "splat/caches.h"
#include "splat/picture/gloss.h"
#include "splat/picture/memory.h"
#include "splat/picture/noise_target.h"
#include "splat/picture/report.h"
#include "temporal/film/inputs.h"

namespace {

using namespace phos;

/// What was given for nothing, and what it lacks.
void tell_of_files(const Tool& tool, const std::vector<Container>& files, const RenderOptions& render,
                   bool glossy) {
  const bool radiance = std::any_of(files.begin(), files.end(), is_radiance);
  const bool brdf = std::any_of(files.begin(), files.end(),
                                [](const Container& f) { return f.provenance().kind == "brdf"; });
  if (render.gloss == GlossBy::cached && !radiance)
    throw Error(ExitCode::usage, "--gloss cached",
                "reads radiance records, and none are given; make them with phos-radiance");
  if (radiance && !glossy) tool.say("nothing here is glossy: radiance records are not used");
  if (brdf && !(radiance && glossy) && render.environment == EnvironmentBy::traced)
    tool.say("the .brdf file is not used: it serves radiance records, and --environment-mode hsh");
}

void require_finite(const Image& image) {
  std::vector<std::pair<const std::string*, std::span<const float>>> channels;
  for (const auto& [name, values] : image.channels()) channels.emplace_back(&name, values);
  std::vector<std::uint8_t> finite(channels.size());
  parallel_for(channels.size(), 1, [&](std::size_t c) {
    const auto [name, values] = channels[c];
    finite[c] = std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  });
  for (std::size_t c = 0; c < channels.size(); ++c)
    if (finite[c] == 0)
      throw Error(ExitCode::numerical, "",
                  "channel " + *channels[c].first + " has a non-finite value; please report this scene");
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("phos-splat", "renders a scene from its caches",
            "Draws every record of the caches over the visible surface, adds direct light by shadow rays and "
            "what mirrors, glass and glossy surfaces reflect, and writes an OpenEXR image with the layers "
            "beauty (R G B), direct, indirect, glossy, specular, emission, stderr, albedo in cd/m2, "
            "illuminance.Y in lx, weight, normal, position (m, counted from the scene's origin where "
            "phos-scene tells of one) and Z. Another camera, size or --accuracy needs no new cache.",
            14);
  tool.takes_strict();
  Options& options = tool.options();
  std::string scene_path, misses_path, gloss_misses_path;
  std::vector<std::string> cache_paths;
  bool allow_mismatch = false;
  options.input("SCENE", scene_path, "glTF or OBJ scene");
  options.inputs(
      "CACHE", cache_paths,
      "irradiance and radiance caches of that scene, several are joined; its .brdf file (for radiance, else "
      "lobes are projected here, and for --environment-mode hsh)");
  ExrCompression compression = ExrCompression::zip;
  RenderOptions render;
  SceneOptions scene_options;
  declare_options(options, render);
  declare_options(options, scene_options);
  tool.takes_frames(scene_options.frame);
  tool.fresh_each_frame(render);
  options.section("Output");
  options.choice<ExrCompression>(
      "compression", compression,
      {{"zip", ExrCompression::zip}, {"piz", ExrCompression::piz}, {"none", ExrCompression::none}},
      "of the EXR file, lossless: piz is the smallest, none the fastest");
  options.file("misses", misses_path,
               "write the visible points without a record here (CSV), for phos-irradiance --at",
               FileUse::written);
  options.file("gloss-misses", gloss_misses_path,
               "write the visible glossy points without a radiance record here (CSV), for phos-radiance --at",
               FileUse::written);
  options.flag("allow-mismatch", allow_mismatch,
               "accept a cache of another version of the scene, or radiance of fewer bands than its lobes "
               "(recorded)");
  options.example("phos-splat room.glb room.irradiance -o room.exr", "the first camera, 1000 pixels wide");
  options.example(
      "phos-splat room.glb room.irradiance --pixel-samples 1 --edge-samples 8 --layers beauty -o room.exr",
      "a quick one: few samples but at edges, and nothing but the picture");
  options.example("phos-splat room.glb room.irradiance --overlay records -o records.exr",
                  "where the records are, and what each lights");
  options.example("phos-splat room.glb room.irradiance --camera desk --misses m.csv -o desk.exr",
                  "another camera from the same cache, and the points it lacks");
  options.example("phos-splat film.glb film.irradiance --frames 0:99 -o film/%04d.exr",
                  "an animation; ranges may be given to several machines");

  std::vector<Container> files;  // open from the first frame on
  return tool.run(argc, argv, [&] {
    tool.add_input("scene", scene_files(scene_path, scene_options));
    for (std::size_t i = 0; i < cache_paths.size(); ++i) tool.add_input(text("cache ", i), cache_paths[i]);
    render.seed = tool.seed();
    const std::string misses = tool.frame_path(misses_path, "--misses");
    const std::string gloss_misses = tool.frame_path(gloss_misses_path, "--gloss-misses");
    tool.set_provenance_reader(read_image_provenance);
    if (options.given("reuse") && !(misses_path.empty() && gloss_misses_path.empty()))
      throw Error(ExitCode::usage, misses_path.empty() ? "--gloss-misses" : "--misses",
                  "a picture that is not made anew has no misses; leave out --reuse");
    require_one_choice(options, render);
    if (tool.up_to_date()) return;

    if (files.empty()) files = open_caches(cache_paths);
    const Scene scene = [&] {
      const auto timer = tool.time("load scene");
      return load_scene(scene_path, scene_options);
    }();
    tell_losses(tool, scene);
    if (const auto frames = tool.frames()) require_frames(scene, *frames);
    if (!allow_mismatch)
      for (const Container& file : files) require_same_scene(file, scene_path, scene);
    const bool stated = tell_unsampled_in(tool, files).empty();
    const bool glossy = !glossy_materials(scene).empty();
    tell_of_files(tool, files, render, glossy);
    SplatCaches caches = read_caches(files, scene, glossy);
    if (caches.irradiance.quantity == "all")
      tool.say("the cache holds direct light too: only gloss is lit by shadow rays");
    resolve(render, find_camera(scene, render.camera), caches.irradiance, caches.radiance);

    if (render.splat == SplatBy::gl && any_footprint(caches.irradiance.records))
      tool.say("the cache has adaptive records: they are drawn on the CPU (--splat cpu)");

    if (const std::string memory = require_memory(render); !memory.empty()) tool.say(memory);
    const RayScene rays = [&] {
      const auto timer = tool.time("build rays");
      return RayScene(scene, {render.isa});
    }();
    if (const auto inside = camera_inside_solid(rays, find_camera(scene, render.camera))) tool.warn(*inside);
    if (render.direct == DirectBy::shadow_map && rays.has_panes())
      tool.say("light comes through panes, which shadow maps do not show: shadow rays stand in for them");
    const PictureGloss gloss = [&] {
      const auto timer = tool.time("gloss tables");
      return gloss_of_picture(rays, caches, render, allow_mismatch, tool.counters());
    }();
    if (gloss.projected) tool.say("lobes were projected here; phos-brdf keeps them, and has options");
    report_noise(
        tool, render,
        choose_rays(rays, caches.irradiance, render, caches.brdf, gloss.cache ? &*gloss.cache : nullptr));
    Rendering rendering =
        render_scene(rays, caches.irradiance, render, caches.brdf, gloss.cache ? &*gloss.cache : nullptr);
    require_finite(rendering.image);
    if (!stated) rendering.image = without_errors(rendering.image);
    if (!scene.animation.empty()) rendering.image.attributes[kFramesPerSecond] = shortest(scene.frames_per_s);
    set_provenance(rendering.image, tool.provenance("image", scene.hash, scene.parts));
    const auto timer = tool.time("write");
    write_exr(tool.output(), rendering.image, compression);
    if (!misses.empty()) write_misses(misses, rendering.misses, scene.origin_m);
    if (!gloss_misses.empty()) write_misses(gloss_misses, rendering.gloss_misses, scene.origin_m);
    report_picture(tool, render, rendering, gloss, misses, gloss_misses);
    tool.say(text(tool.output(), ": ", render.width, " x ", render.height, " from ",
                  caches.irradiance.records.size(), " records"));
  });
}
