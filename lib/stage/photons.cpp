#include "stage/photons.h"

#include <cmath>
#include <optional>

#include "core/text/quantity.h"
#include "photon/events.h"
#include "photon/photon_map.h"
#include "photon/photon_shards.h"
#include "scene/nested_glass.h"
#include "scene/rays.h"
#include "scene/sky/access.h"

namespace phos::stage {
namespace {

void report(Tool& tool, const PhotonTotals& totals) {
  const double escaped = luminance(totals.escaped_flux_lm), emitted = luminance(totals.emitted_flux_lm);
  const double per_path =
      totals.paths > 0 ? static_cast<double>(totals.stored) / static_cast<double>(totals.paths) : 0;
  tool.say(text(totals.paths, " paths emitted, ", totals.stored, " photons stored (",
                std::round(100 * per_path) / 100, " per path); ", luminance(totals.emitted_flux_lm),
                " lm emitted, ", percent_to_tenths(emitted > 0 ? escaped / emitted : 0),
                " of it left the scene"));
  if (totals.stored == 0)
    tool.warn(totals.paths == 0
                  ? "no paths were emitted (--photons 0): the map is empty"
                  : "every photon left the scene: the map is empty; do the lights face surfaces?");
  if (const std::uint64_t kept = tool.counters()[kKeptInGlassEvent]; kept > 0)
    tool.say(text(kept, " photons ended in glass: total reflection keeps their light in it"));
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
  for (const Event* event : {&kNonFiniteEvent, &kTooLongEvent}) counters.require_allowed(*event, trials);
}

}  // namespace

void run(Tool& tool, const PhotonsCommand& asked) {
  const PhotonOptions& options = asked.photons;
  path_range(options.shard, options.paths);  // a wrong --shard is said before the work
  tool.add_input("scene", scene_files(asked.scene_path, asked.scene));
  if (!options.shard.empty()) tool.set_variant("shard " + options.shard);
  if (tool.up_to_date()) return;

  std::optional<Scene> scene;
  std::optional<RayScene> rays;
  {
    const Tool::Timer timer = tool.time("load");
    scene = load_scene(asked.scene_path, asked.scene);
    tell_losses(tool, *scene);
    rays.emplace(*scene, RayOptions{options.isa});
  }
  PhotonTotals totals;
  Photons photons;
  {
    const Tool::Timer timer = tool.time("trace");
    photons = trace_photons(*rays, options, tool.seed(), totals, tool.counters());
  }
  if (const auto nested = nested_glass(*rays)) tool.warn(*nested);
  report_openings(tool, *rays, options, !asked.scene.portals.empty());
  check_events(tool.counters(), totals);
  report(tool, totals);
  const Provenance provenance = tool.provenance(FileKind::photons, scene->hash, scene->parts);
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
}

}  // namespace phos::stage
