#include "stage/splat.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "image/image.h"
#include "image/image_provenance.h"
#include "image/without_errors.h"
#include "radiance/brdf/projection.h"
#include "scene/inside_solid.h"
#include "scene/motion/film.h"
#include "scene/nested_glass.h"
#include "scene/rays.h"
#include "scene/report/unsampled.h"
#include "splat/caches.h"
#include "splat/gl/choice.h"
#include "splat/picture/gloss.h"
#include "splat/picture/memory.h"
#include "splat/picture/misses.h"
#include "splat/picture/noise_target.h"
#include "splat/picture/report.h"
#include "stage/inputs.h"
#include "stage/site.h"
#include "temporal/film/file.h"

namespace phos::stage {
namespace {

/// Tells of inputs that are not used. Throws Error(usage) where gloss from records lacks the records.
void tell_of_files(const Tool& tool, const std::vector<Container>& files, const RenderOptions& render,
                   bool glossy) {
  const bool radiance = std::any_of(files.begin(), files.end(), is_radiance);
  const bool brdf =
      std::any_of(files.begin(), files.end(), [](const Container& f) { return f.kind() == FileKind::brdf; });
  if (render.gloss == GlossBy::cached && !radiance)
    throw Error(ExitCode::usage, "--gloss cached",
                "reads radiance records, and none are given; make them with phos-radiance");
  const bool lives = render.overlay != Overlay::none && render.overlay_colour == OverlayColour::life;
  if (lives && std::none_of(files.begin(), files.end(), is_film))
    throw Error(
        ExitCode::usage, "--overlay-colour life",
        "tells how long the records of a film live, and no film is given; make one with phos-temporal");
  if (radiance && !glossy) tool.say("the scene has no gloss: radiance records are not used");
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

void run(Tool& tool, SplatCommand& asked) {
  const InputFiles inputs = scene_and_others(asked.scene_path, asked.caches);
  RenderOptions& render = asked.render;
  take_site(tool, inputs.phos, asked.allow_mismatch);
  tool.add_input("scene", scene_files(inputs.scene, asked.scene));
  for (std::size_t i = 0; i < inputs.phos.size(); ++i) tool.add_input(text("cache ", i), inputs.phos[i]);
  render.seed = tool.seed();
  const std::string misses = tool.frame_path(asked.misses, "--misses");
  const std::string gloss_misses = tool.frame_path(asked.gloss_misses, "--gloss-misses");
  tool.set_provenance_reader(read_image_provenance);
  if (tool.options().given("reuse") && !(asked.misses.empty() && asked.gloss_misses.empty()))
    throw Error(ExitCode::usage, asked.misses.empty() ? "--gloss-misses" : "--misses",
                "a picture that is not made anew has no misses; leave out --reuse");
  require_one_choice(tool.options(), render);
  use_gl(tool, asked.gl);
  if (tool.up_to_date()) return;

  std::vector<Container>& files = asked.opened;
  if (files.empty()) files = open_caches(inputs.phos, CacheKinds::records_and_lobes);
  const Scene scene = [&] {
    const auto timer = tool.time("load scene");
    return load_scene(inputs.scene, asked.scene);
  }();
  tell_losses(tool, scene);
  if (const auto frames = tool.frames()) require_frames(scene, *frames);
  require_together(files, inputs.scene, scene, asked.allow_mismatch);
  const bool stated = tell_unsampled_in(tool, files).empty();
  const bool glossy = !glossy_materials(scene).empty();
  tell_of_files(tool, files, render, glossy);
  SplatCaches caches = read_caches(files, scene, glossy, render.overlay_colour == OverlayColour::life);
  if (caches.irradiance.quantity == Quantity::all)
    tool.say("the cache holds direct light too: only gloss is lit by shadow rays");
  if (render.splat == SplatBy::gl && any_footprint(caches.irradiance.records))
    tool.say("the records have footprints, which OpenGL draws one at a time: --splat cpu is faster");
  resolve(render, find_camera(scene, render.camera), caches.irradiance, caches.radiance);

  if (const std::string memory = require_memory(render); !memory.empty()) tool.say(memory);
  const RayScene rays = [&] {
    const auto timer = tool.time("build rays");
    return RayScene(scene, {render.isa});
  }();
  if (const auto nested = nested_glass(rays)) tool.warn(*nested);
  if (const auto inside = camera_inside_solid(rays, find_camera(scene, render.camera))) tool.warn(*inside);
  if (render.direct == DirectBy::shadow_map && rays.has_panes())
    tool.say("light comes through panes, which shadow maps do not show: shadow rays stand in for them");
  const PictureGloss gloss = [&] {
    const auto timer = tool.time("gloss tables");
    return gloss_of_picture(rays, caches, render, asked.allow_mismatch, tool.counters());
  }();
  if (gloss.projected) tool.say("lobes were projected here; phos-brdf stores them, and has options for them");
  const GlossCache* recorded = gloss.cache ? &*gloss.cache : nullptr;
  const NoiseTarget noise = choose_rays(rays, caches.irradiance, render, caches.brdf, recorded);
  report_noise(tool, render, noise);
  Rendering rendering =
      render_scene(rays, caches.irradiance, render, caches.brdf, recorded, caches.lives, noise.doublings);
  require_finite(rendering.image);
  if (!stated) rendering.image = without_errors(rendering.image);
  if (!scene.animation.empty()) rendering.image.attributes[kFramesPerSecond] = shortest(scene.frames_per_s);
  set_provenance(rendering.image, tool.provenance(FileKind::image, scene.hash, scene.parts));
  const auto timer = tool.time("write");
  write_exr(tool.output(), rendering.image, asked.compression);
  if (!misses.empty()) write_misses(misses, rendering.misses, scene.origin_m);
  if (!gloss_misses.empty()) write_misses(gloss_misses, rendering.gloss_misses, scene.origin_m);
  report_picture(tool, render, rendering, gloss, misses, gloss_misses);
  tool.say(text(tool.output(), ": ", render.width, " x ", render.height, " from ",
                caches.irradiance.records.size(), " records"));
}

}  // namespace phos::stage
