#include "scene/load.h"

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/text/named_files.h"
#include "file/atomic_file.h"
#include "file/lfs_pointer.h"
#include "scene/gltf/document.h"
#include "scene/gltf/load.h"
#include "scene/lamp/shine_only.h"
#include "scene/obj/lights.h"
#include "scene/obj/load.h"
#include "scene/opening/find_blinds.h"
#include "scene/opening/find_portals.h"
#include "scene/opening/portal_sight.h"
#include "scene/sky/daylight.h"
#include "scene/sky/environment.h"
#include "scene/spectral/to_bands.h"

namespace phos::inline scene {
namespace {

bool is_gltf(const std::string& bytes) { return looks_like_glb(bytes) || looks_like_json(bytes); }

/// A folder, say, opens but cannot be read.
std::string scene_bytes(const std::string& path) {
  std::string bytes = read_text(path);
  if (bytes.empty()) throw Error(ExitCode::bad_input, path, "the file is empty; export the scene again");
  if (is_lfs_pointer(bytes))
    throw Error(ExitCode::bad_input, path, text("neither glTF nor OBJ, but ", kLfsPointer));
  return bytes;
}

/// Looks for the openings.
void aim(Scene& scene, const std::string& portals) {
  if (!scene.environment)
    throw Error(ExitCode::usage, "--portals",
                "aims the light of a sky, and the scene has no sky; give --sky, --sun or --environment");
  const RayScene rays(scene);
  scene.portal = find_portals(rays, portals);
  scene.blind = find_blinds(rays);
  if (scene.portal.empty())
    scene.warnings.emplace_back(Note::Level::info, "loader", "", "", kNothingToAimAt);
  else
    scene.portal_sight = std::make_shared<const PortalSight>(rays, scene.portal);
}

}  // namespace

void declare_options(Options& options, SceneOptions& scene) {
  options.section("Scene");
  options.number("time", scene.time_s, "SECONDS",
                 "time of the animations (default: the time of the caches that are read, else 0)", {},
                 Adopted::site);
  options.number(
      "frame", scene.frame, "N",
      "the time as a frame number, counted from 0, at the frame rate of the scene; instead of --time", {},
      Adopted::site);
  declare_light_options(options, scene);
}

void declare_light_options(Options& options, SceneOptions& scene) {
  declare_options(options, scene.luminaires);
  options.file("environment", scene.environment,
               "light from all directions: an equirectangular map, twice as wide as high, with +Y up and +Z "
               "in the middle; Radiance .hdr (times 179 lm/W) or OpenEXR (cd/m2). Give it to every stage");
  options.number("environment-rotation", scene.environment_rotation_deg, "DEGREES",
                 "turns the environment about +Y, counter-clockwise seen from above (default: 0)",
                 {-360, 360}, Adopted::site);
  options.number("environment-scale", scene.environment_scale, "X",
                 "multiplies the luminance of the environment (default: 1)", kPositive, Adopted::site);
  declare_options(options, scene.daylight);
  declare_options(options, scene.bands);
  options.text(
      "lamps", scene.lamps, "NAMES",
      "only these lamps shine (default: all): lights, nodes whose surfaces emit, and environment for "
      "a map, sky and sun, separated by commas (as in --portals). The light of disjoint groups of "
      "lamps adds up, and phos-view dims each",
      {Recorded::if_given, Adopted::site});
  options.text("portals", scene.portals, "auto|NAMES",
               "openings that photons and shadow rays of sky, sun and environment are aimed at (default: "
               "none). auto: the openings through which the sky is seen from within; NAMES: nodes or "
               "materials whose surfaces fill openings, such as panes, separated by commas (a comma within a "
               "name of the scene does not separate, nor does \\,). One in ten is not aimed (one shadow ray "
               "in two where a sky or map has bright spots), so that no light is lost",
               {Recorded::if_given, Adopted::site});
}

Scene load_scene(const std::string& path, const SceneOptions& options) {
  if (options.time_s && options.frame)
    throw Error(ExitCode::usage, "--time", "and --frame set the same time; give one of them");
  if (options.environment.empty() && (options.environment_rotation_deg || options.environment_scale))
    throw Error(
        ExitCode::usage, "--environment",
        "is missing: --environment-rotation and --environment-scale change its map; give --environment FILE");
  if (!options.environment.empty() && options.daylight.any())
    throw Error(ExitCode::usage, options.daylight.sky.empty() ? "--sun" : "--sky",
                "and --environment both light the scene from beyond; leave one of them out");
  check(options.bands);
  const Daylight daylight = resolve(options.daylight);
  const std::string bytes = scene_bytes(path);
  Scene scene;
  try {
    scene = is_gltf(bytes) ? load_gltf(path, bytes, options) : load_obj(path, bytes, options);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ExitCode::no_memory, path, "the scene does not fit into memory; use a larger machine");
  } catch (const std::exception& e) {
    throw Error(ExitCode::bad_input, path, text("malformed: ", e.what(), "; export the scene again"));
  }
  if (!options.environment.empty()) {
    EnvironmentFile file = read_environment(options.environment, options.environment_scale.value_or(1),
                                            glm::radians(options.environment_rotation_deg.value_or(0)));
    scene.environment = std::make_shared<const Environment>(std::move(file.map));
    if (file.outside_gamut > 0) {
      scene.warnings.emplace_back(
          Note::Level::info, "loader", "", "",
          text(options.environment, ": ", file.outside_gamut,
               " texels have colours outside of Rec.709; they are made less saturated, their luminance is "
               "kept"));
    }
  }
  if (options.daylight.any()) {
    scene.environment = std::make_shared<const Environment>(make_environment(daylight));
    for (const std::string& line : daylight.warnings)
      scene.warnings.emplace_back(Note::Level::info,
                                  line.ends_with(kMoreThanInSpace) ? kSunTooBright : "loader", "", "", line);
  }
  if (options.bands.any()) to_bands(scene, options.bands);
  const bool beyond = scene.environment != nullptr;
  if (!options.lamps.empty()) shine_only(scene, options.lamps);
  finalize(scene);
  const bool dark_beyond = beyond && !scene.environment;  // by --lamps
  if (!options.portals.empty() && !dark_beyond) aim(scene, options.portals);
  return scene;
}

std::vector<std::string> scene_files(const std::string& path, const SceneOptions& options) {
  const std::string bytes = scene_bytes(path);
  std::vector<std::string> files = is_gltf(bytes) ? gltf_external_files(path, bytes, options.bands.any())
                                                  : obj_external_files(path, bytes);
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  std::erase_if(files, [](const std::string& file) {
    std::error_code ignored;
    return !std::filesystem::is_regular_file(file, ignored);
  });
  files.insert(files.begin(), path);
  for (std::string& file : luminaire_files(options.luminaires)) files.push_back(std::move(file));
  if (options.bands.any())
    for (const NamedFile& w : named_files(options.bands.spectra, "--spectrum")) files.push_back(w.file);
  if (!options.environment.empty()) files.push_back(options.environment);
  return files;
}

std::string how_to_add_to(const Scene& scene) {
  try {
    if (!is_gltf(scene_bytes(scene.path)))
      return text("add one in ", obj_lights_path(scene.path), " (phos-scene --help shows its form)");
  } catch (const Error&) {  // made in memory, or removed since
  }
  return "add one in the modeller";
}

const Camera& find_camera(const Scene& scene, const std::string& name) {
  if (scene.camera.empty())
    throw Error(ExitCode::bad_input, scene.path, "the scene has no camera; " + how_to_add_to(scene));
  if (name.empty()) return scene.camera.front();
  std::string names;
  for (const Camera& camera : scene.camera) {
    if (camera.name == name) return camera;
    names += (names.empty() ? "\"" : ", \"") + camera.name + "\"";
  }
  throw Error(ExitCode::usage, "--camera", "there is no camera \"" + name + "\"; the scene has " + names);
}

}  // namespace phos::inline scene
