// Traces photons from the lights of a scene and writes the map of where they land.
#include <cmath>
#include <optional>

#include "file/tool.h"
#include "photon/photon_map.h"
#include "photon/trace.h"
#include "scene/load.h"
#include "scene/rays.h"
#include "scene/sky/access.h"

namespace {

using namespace phos;

double percent(double part, double whole) { return whole > 0 ? std::round(1000 * part / whole) / 10 : 0; }

void report(Tool& tool, const PhotonTotals& totals) {
  const double escaped = luminance(totals.escaped_flux_lm), emitted = luminance(totals.emitted_flux_lm);
  const double per_path =
      totals.paths > 0 ? static_cast<double>(totals.stored) / static_cast<double>(totals.paths) : 0;
  tool.say(text(totals.paths, " paths emitted, ", totals.stored, " photons stored (",
                std::round(100 * per_path) / 100, " per path); ", luminance(totals.emitted_flux_lm),
                " lm emitted, ", percent(escaped, emitted), " % of it left the scene"));
  if (totals.stored == 0)
    tool.warn(totals.paths == 0
                  ? "no paths were emitted (--photons 0): the map is empty"
                  : "every photon left the scene: the map is empty; do the lights face surfaces?");
  tool.stat("paths", totals.paths);
  tool.stat("stored", totals.stored);
}

/// Light of a sky that nothing of the scene lets in, or that cannot be aimed.
void report_openings(Tool& tool, const RayScene& rays, const PhotonOptions& options, bool to_aim) {
  if (!rays.scene().environment || options.paths == 0) return;
  if (const std::optional<std::string> closed = closed_to_the_sky(rays)) tool.warn(*closed);
  if (to_aim && rays.scene().portal.empty()) tool.warn(kNothingToAimAt);
}

void check_events(const Counters& counters, const PhotonTotals& totals) {
  const std::uint64_t trials = totals.stored + totals.paths;
  for (const char* event : {kNonFiniteEvent, kTooLongEvent}) counters.require_allowed(event, trials);
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("phos-photons", "traces photons from the lights and stores where they land",
            "Emits photons from every light of the scene, follows them from surface to surface (Russian "
            "roulette, no limit "
            "on bounces) and stores one at each surface they reach. The file holds the photons and a kd-tree "
            "over them, and "
            "feeds phos-irradiance. The same command gives the same bytes on any number of threads.",
            5);
  std::string scene_path;
  SceneOptions scene_options;
  PhotonOptions options;
  tool.options().input("SCENE", scene_path, "glTF (.glb, .gltf) or OBJ scene");
  declare_options(tool.options(), options);
  declare_options(tool.options(), scene_options);
  tool.takes_strict();
  tool.options().example("phos-photons room.glb --photons 1000000 -o room.photons", "a million paths");
  tool.options().example("phos-photons room.glb --shard 1/2 -o a.photons",
                         "half of them, to be joined by phos-merge");
  return tool.run(argc, argv, [&] {
    path_range(options.shard, options.paths);  // a wrong --shard is said before the work
    tool.add_input("scene", scene_files(scene_path, scene_options));
    if (!options.shard.empty()) tool.set_variant("shard " + options.shard);
    if (tool.up_to_date()) return;

    std::optional<Scene> scene;
    std::optional<RayScene> rays;
    {
      const Tool::Timer timer = tool.time("load");
      scene = load_scene(scene_path, scene_options);
      tell_losses(tool, *scene);
      rays.emplace(*scene, RayOptions{options.isa});
    }
    PhotonTotals totals;
    Photons photons;
    {
      const Tool::Timer timer = tool.time("trace");
      photons = trace_photons(*rays, options, tool.seed(), totals, tool.counters());
    }
    report_openings(tool, *rays, options, !scene_options.portals.empty());
    check_events(tool.counters(), totals);
    report(tool, totals);
    const Provenance provenance = tool.provenance("photons", scene->hash, scene->parts);
    if (!options.shard.empty()) {
      const Tool::Timer timer = tool.time("write");
      write_shard(tool.output(), photons, totals, options.shard, provenance);
      return;
    }
    std::optional<PhotonMap> map;
    {
      const Tool::Timer timer = tool.time("kdtree");
      map = PhotonMap::build(std::move(photons), totals);
    }
    const Tool::Timer timer = tool.time("write");
    map->write(tool.output(), provenance);
  });
}
