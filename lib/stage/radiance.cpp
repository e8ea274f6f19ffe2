#include "stage/radiance.h"

#include <functional>
#include <sstream>

#include "estimate/record_ways.h"
#include "file/adoption.h"
#include "place/modes.h"
#include "place/points_on_surfaces.h"
#include "place/radiance_report.h"
#include "place/read_points.h"
#include "place/typical_distance.h"
#include "radiance/gloss_report.h"
#include "scene/nested_glass.h"
#include "splat/gl/choice.h"
#include "splat/raster/hemisphere_raster.h"
#include "stage/chosen_estimator.h"
#include "stage/inputs.h"
#include "stage/record_inputs.h"
#include "stage/site.h"

namespace phos::stage {
namespace {

void tell_of_gloss(Tool& tool, const Json& report, bool projected_here) {
  tool.stat("gloss", report);
  std::istringstream lines(gloss_text(report));
  for (std::string line; std::getline(lines, line);) tool.say(line.substr(line.find_first_not_of(' ')));
  if (projected_here) tool.say("lobes were projected here; phos-brdf stores them, and has options for them");
}

void summarise(Tool& tool, const RadianceCache& cache, const std::vector<RadianceRun>& runs) {
  const RadianceReport report = report_of(cache, runs);
  for (const auto& [name, figure] : report.figures.as_object()) tool.stat(name, figure);
  for (const std::string& line : report.lines) tool.say(line);
}

}  // namespace

void run(Tool& tool, RadianceCommand& asked) {
  RadianceOptions& radiance = asked.radiance;
  PlacementOptions& placement = asked.placement;
  const RecordFiles files = sort_record_inputs(asked.inputs);
  take_site(tool, {files.photons, files.source, files.radiance, asked.add_to}, asked.allow_mismatch);
  add_inputs(tool, files, asked.scene);
  if (!asked.at.empty()) tool.add_input("points", asked.at);
  if (!asked.add_to.empty()) tool.add_input("radiance", asked.add_to);
  if (radiance.records.estimate == Estimate::raster) use_gl(tool, asked.gl);
  if (tool.up_to_date()) return;

  const Scene scene = load_scene(files.scene, asked.scene);
  tell_losses(tool, scene);
  const RecordInputs inputs = open_record_inputs(files, scene, asked.allow_mismatch);
  const GlossTables tables = [&] {
    const auto timer = tool.time("tables");
    return GlossTables(scene, inputs.brdf, asked.gloss, {}, tool.counters());
  }();
  RadianceCache cache;
  std::vector<LightWay> missed_before;
  if (!asked.add_to.empty()) {
    const Container earlier =
        open_to_add(asked.add_to, FileKind::radiance, files, scene, asked.allow_mismatch);
    adopt_estimate(tool.options(), earlier);
    missed_before = unsampled_in(earlier.provenance());
    cache = read_radiance(earlier);
    require_same_orders(cache, tables, asked.add_to);
  }
  cache.accuracy = radiance.records.accuracy;
  cache.scene_hash = scene.hash;
  const IrradianceCache earlier = irradiance_of(cache);
  cache.caustics = caustics_of_run(inputs, scene, asked.add_to.empty() ? nullptr : &earlier, asked.add_to);
  radiance.records.caustics_apart = cache.caustics != nullptr;

  std::vector<SurfaceSample> points;
  if (!asked.at.empty()) points = read_points(asked.at, scene.origin_m);
  PlacementSource source{inputs.photons ? &*inputs.photons : nullptr, !asked.at.empty(), points, tool.seed()};
  resolve(placement, scene, source, radiance.records.accuracy);
  const RayScene rays(scene, {asked.isa});
  if (const auto nested = nested_glass(rays)) tool.warn(*nested);
  tell_raster_light(tool, rays, radiance.records);
  const TypicalDistance typical = typical_distance(rays, placement, source);
  tool.stat("typical_distance_m", typical.least_m);
  radiance.records.resolve(typical);
  tell_of_gloss(tool, gloss_report(scene, tables), files.brdf.empty() && !tables.orders().empty());
  std::vector<LightWay> missed;
  if (!tables.orders().empty()) missed = tell_missed_ways(tool, rays, radiance.records);
  missed = tell_unsampled_kept(tool, asked.add_to, missed_before, missed);
  if (tables.orders().empty()) {
    tool.say(text(tables.choices().empty() ? "the scene has no gloss" : "all gloss is traced by rays",
                  ": the file is empty"));
  } else {
    if (!asked.at.empty())
      source.points = points = require_surfaces(tool, rays, points, kOnSurface * typical.least_m, asked.at,
                                                "radiance records", "let phos-sense read light there");
    const ChosenRadianceEstimators estimators = [&] {
      const auto timer = tool.time("coarse records");
      return ChosenRadianceEstimators(rays, inputs, radiance, tool.seed());
    }();
    if (estimators.coarse_records() > 0) tool.stat("coarse_records", estimators.coarse_records());
    const auto timer = tool.time("records");
    summarise(tool, cache,
              place_radiance(cache, tables, std::ref(estimators), rays, radiance.records, placement, source,
                             tool.counters()));
    if (cache.records.empty()) tool.warn("no place needs a record (see --place): the file is empty");
  }
  Provenance provenance = tool.provenance(FileKind::radiance, scene.hash, scene.parts);
  note_unsampled(provenance, missed);
  write_radiance(tool.output(), cache, provenance, asked.store);
}

}  // namespace phos::stage
