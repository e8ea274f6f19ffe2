// phos-splat: scene + irradiance cache -> OpenEXR picture.
#include <algorithm>
#include <cmath>

#include "cache/irradiance_cache.h"
#include "file/container.h"
#include "file/tool.h"
#include "image/image.h"
#include "image/image_provenance.h"
#include "scene/load.h"
#include "scene/rays.h"
#include "splat/caches.h"
#include "splat/render.h"

namespace {

using namespace phos;

void put_stats(Tool& tool, const Rendering& rendering) {
  for (const auto& [part, seconds] : rendering.seconds.as_object()) tool.stat("seconds." + part, seconds);
  tool.stat("renderer", rendering.renderer);
  tool.stat("cache lookups", rendering.looked_up);
  tool.stat("cache misses", rendering.missed);
  if (rendering.edge_pixels > 0) tool.stat("edge pixels", rendering.edge_pixels);
  tool.counters().merge(rendering.counters);
}

void warn_of_misses(const Tool& tool, const Rendering& rendering) {
  if (rendering.missed == 0) return;
  const double share = static_cast<double>(rendering.missed) / static_cast<double>(rendering.looked_up);
  tool.warn(text(shortest(std::ceil(1e4 * share) / 100),
                 " % of the visible points have no record near enough (farther ones light them); write them "
                 "with --misses, fill them "
                 "with phos-irradiance --at, or raise --accuracy"));
}

void tell_of_records(Tool& tool, const RenderOptions& render, const Rendering& rendering) {
  if (render.overlay == Overlay::none) return;
  const DrawnRecords& drawn = rendering.drawn;
  tool.stat("overlay.records", drawn.count);
  tool.stat("overlay.least", drawn.least);
  tool.stat("overlay.most", drawn.most);
  const bool radius = render.overlay_colour == OverlayColour::radius;
  const auto value = [&](double v) {
    return radius ? shortest(static_cast<float>(v)) + " m" : shortest(static_cast<float>(100 * v)) + " %";
  };
  tool.say(text(drawn.count, " records drawn; ", radius ? "radius" : "standard error", " from ",
                value(drawn.least), " (blue) to ", value(drawn.most), " (red), logarithmic"));
}

void require_finite(const Image& image) {
  for (const auto& [name, values] : image.channels())
    for (const float v : values)
      if (!std::isfinite(v))
        throw Error(ExitCode::numerical, "",
                    "channel " + name + " has a non-finite value; please report this scene");
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("phos-splat", "renders a scene from its irradiance cache",
            "Draws every record of the caches over the visible surface, adds direct light by shadow rays and "
            "what mirrors, "
            "glass and glossy surfaces reflect, and writes an OpenEXR image with the layers beauty (R G B), "
            "direct, "
            "indirect, glossy, specular, emission, stderr, albedo in cd/m2, illuminance.Y in lx, weight, "
            "normal, position "
            "and Z. Another camera, size or --accuracy needs no new cache.",
            1);
  Options& options = tool.options();
  std::string scene_path, misses_path;
  std::vector<std::string> cache_paths;
  bool allow_mismatch = false;
  options.input("SCENE", scene_path, "glTF or OBJ scene");
  options.inputs(
      "CACHE", cache_paths,
      "irradiance caches of that scene, several are joined; its .brdf file (for --environment-mode hsh)");
  ExrCompression compression = ExrCompression::zip;
  RenderOptions render;
  SceneOptions scene_options;
  declare_options(options, render);
  declare_options(options, scene_options);
  options.section("Output");
  options.choice<ExrCompression>(
      "compression", compression,
      {{"zip", ExrCompression::zip}, {"piz", ExrCompression::piz}, {"none", ExrCompression::none}},
      "of the EXR file, lossless: none is the fastest");
  options.file("misses", misses_path,
               "write the visible points without a record here (CSV), for phos-irradiance --at");
  options.flag("allow-mismatch", allow_mismatch, "accept a cache of another version of the scene (recorded)");
  options.example("phos-splat room.glb room.irradiance -o room.exr", "the first camera, 1000 pixels wide");
  options.example(
      "phos-splat room.glb room.irradiance --pixel-samples 1 --edge-samples 8 --layers beauty -o room.exr",
      "a quick one: few samples but at edges, and nothing but the picture");
  options.example("phos-splat room.glb room.irradiance --overlay records -o records.exr",
                  "where the records are, and what each lights");
  options.example("phos-splat room.glb room.irradiance --camera desk --misses m.csv -o desk.exr",
                  "another camera from the same cache, and the points it lacks");

  return tool.run(argc, argv, [&] {
    tool.add_input("scene", scene_files(scene_path, scene_options));
    for (std::size_t i = 0; i < cache_paths.size(); ++i) tool.add_input(text("cache ", i), cache_paths[i]);
    render.seed = tool.seed();
    tool.set_provenance_reader(read_image_provenance);
    if (options.given("reuse") && !misses_path.empty())
      throw Error(ExitCode::usage, "--misses",
                  "a picture that is not made anew has no misses; leave out --reuse");
    if (tool.up_to_date()) return;

    const std::vector<Container> files = open_caches(cache_paths);
    const Scene scene = [&] {
      const auto timer = tool.time("load scene");
      return load_scene(scene_path, scene_options);
    }();
    if (!allow_mismatch)
      for (const Container& file : files) require_same_scene(file, scene_path, scene.hash, scene.parts);
    const SplatCaches caches = read_caches(files);
    const IrradianceCache& cache = caches.irradiance;
    if (!caches.brdf.empty() && render.environment == EnvironmentBy::traced)
      tool.say("the .brdf file is not used: it serves --environment-mode hsh");
    if (cache.quantity == "all")
      tool.say("the cache holds direct light too: only gloss is lit by shadow rays");
    resolve(render, find_camera(scene, render.camera), cache);

    const RayScene rays = [&] {
      const auto timer = tool.time("build rays");
      return RayScene(scene, {render.isa});
    }();
    Rendering rendering = render_scene(rays, cache, render, caches.brdf);
    put_stats(tool, rendering);
    tell_of_records(tool, render, rendering);
    require_finite(rendering.image);
    set_provenance(rendering.image, tool.provenance("image", scene.hash, scene.parts));
    const auto timer = tool.time("write");
    write_exr(tool.output(), rendering.image, compression);
    if (misses_path.empty()) {
      warn_of_misses(tool, rendering);
    } else {
      write_misses(misses_path, rendering.misses);
      tool.say(text(misses_path, ": ", rendering.misses.size(), " points without a record"));
    }
    tool.say(text(tool.output(), ": ", render.width, " x ", render.height, " from ", cache.records.size(),
                  " records"));
  });
}
