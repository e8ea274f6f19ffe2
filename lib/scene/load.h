// Reading .glb, .gltf and .obj.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/options.h"
#include "scene/luminaire/options.h"
#include "scene/scene.h"
#include "scene/sky/daylight_options.h"
#include "scene/spectral/band_options.h"

namespace phos::inline scene {

/// Options of every stage that reads a scene.
struct SceneOptions {
  std::optional<double> time_s;  ///< where animations are evaluated
  std::optional<double> frame;   ///< the same, in frames
  std::string environment;       ///< file of an environment map; "": none
  std::optional<double> environment_rotation_deg, environment_scale;
  DaylightOptions daylight;
  std::string portals;  ///< where light from infinity is aimed: "auto", names, or "": nowhere
  LuminaireOptions luminaires;
  BandOptions bands;
  std::string lamps;  ///< names of the lamps that shine; "": all do
};
void declare_options(Options& options, SceneOptions& scene);
/// Those that hold at every time: luminaires, the environment, sky and sun, bands, lamps.
void declare_light_options(Options& options, SceneOptions& scene);

/// What a scene warns of whose --portals auto finds nothing.
inline constexpr const char* kNothingToAimAt =
    "--portals auto: no place sees the sky from within; nothing is aimed";

/// Loads and finalizes, with the environment map or the daylight that the options name. The format is told
/// from the content. Throws Error(bad_input): missing, not a scene, truncated, unknown required extension
/// (named), glTF 1.0, index out of range, NaN vertex, no triangles, ...
Scene load_scene(const std::string& path, const SceneOptions& options = {});

/// The scene file and every file it refers to (buffers, images, .mtl, lights), for content hashes. Missing
/// ones are left out; luminaires, spectra and the environment map of the options come last. Throws
/// Error(bad_input) if the scene file itself cannot be read.
std::vector<std::string> scene_files(const std::string& path, const SceneOptions& options = {});

/// How a user adds cameras or lights to the file that a scene was read from: in the modeller, or, as OBJ
/// cannot hold them, in a file beside it, which is named.
std::string how_to_add_to(const Scene& scene);

/// The camera of that name, or the first. Throws Error(usage) naming the cameras there are; Error(bad_input)
/// if none.
const Camera& find_camera(const Scene& scene, const std::string& name);

}  // namespace phos::inline scene
