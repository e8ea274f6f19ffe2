#include "stage/irradiance.h"

#include <sstream>

#include "estimate/record_ways.h"
#include "file/adoption.h"
#include "photon/caustic_map.h"
#include "place/modes.h"
#include "place/parts.h"
#include "place/points_on_surfaces.h"
#include "place/read_points.h"
#include "place/typical_distance.h"
#include "scene/inside_solid.h"
#include "scene/nested_glass.h"
#include "splat/gl/choice.h"
#include "splat/raster/hemisphere_raster.h"
#include "stage/chosen_estimator.h"
#include "stage/inputs.h"
#include "stage/record_inputs.h"
#include "stage/site.h"

namespace phos::stage {
namespace {

std::string percent(double part, double whole) {
  std::ostringstream out;
  out.precision(2);
  out << 100 * part / whole << " %";
  return out.str();
}

/// Of a cache that is begun by rays on every surface, where neither it nor --accuracy is given.
constexpr double kUsualPlacementError = 0.05;

/// --placement-error judges gathered records of circles, which reading blends 1.5 times as far as they reach.
void judge_placement(RecordOptions& records, PlacementOptions& placement, const Options& given) {
  const bool judged = records.estimate == Estimate::gather && records.footprint == Footprint::circle;
  const bool begun = !given.given("accuracy") && !given.given("add-to");
  if (!placement.error && judged && begun && placement.place == Place::surface)
    placement.error = kUsualPlacementError;
  if (!placement.error) return;
  if (!judged)
    throw Error(ExitCode::usage, "--placement-error",
                "needs gathered records with circular footprints; give --estimate gather without "
                "--footprint, or leave it out");
  if (begun) records.accuracy = 1 / 3.0;
}

void summarise(Tool& tool, const IrradianceCache& cache, const PlacementReport& report, bool stated) {
  double light = 0, error = 0;
  for (const IrradianceRecord& r : cache.records) {
    light += static_cast<double>(luminance(r.irradiance)),
        error += static_cast<double>(luminance(r.stderr_lx));
  }
  tool.stat("records", cache.records.size());
  tool.stat("records_new", report.kept);
  tool.stat("records_made", report.made);
  tool.stat("candidates", report.candidates);
  tool.stat("candidates_uncovered", report.uncovered);
  tool.stat("passes", report.passes);
  if (report.made > 0) tool.stat("ms_per_record", 1e3 * report.making_s / static_cast<double>(report.made));
  tool.say(text(cache.records.size(), " records (", report.kept, " new) cover ", report.candidates,
                " candidates in ", report.passes, report.passes == 1 ? " pass" : " passes",
                stated && light > 0 ? "; mean standard error " + percent(error, light) : ""));
  if (report.uncovered_share) {
    tool.stat("uncovered_share", *report.uncovered_share);
    tool.say(text("of the surface that light can reach, ", percent(*report.uncovered_share, 1),
                  " is out of every record's reach; ", report.sides_inside, " of ", report.sides,
                  " sides of triangles lie inside solids"));
  } else if (report.uncovered > 0) {
    tool.say(text(report.uncovered,
                  " candidates are left uncovered by neighbour clamping; raise --passes to cover them"));
  }
}

/// The cache to add to, and the ways of light that it does not hold. Options that were not given become its
/// own; one that was and differs throws Error(mismatch).
IrradianceCache open_earlier(const RecordFiles& files, const Scene& scene, Options& options,
                             const IrradianceCommand& asked, std::vector<LightWay>& missed) {
  const Container file = open_to_add(asked.add_to, FileKind::irradiance, files, scene, asked.allow_mismatch);
  adopt_estimate(options, file);
  missed = unsampled_in(file.provenance());
  return read_irradiance(file);
}

}  // namespace

void run(Tool& tool, IrradianceCommand& asked) {
  RecordOptions& records = asked.records;
  PlacementOptions& placement = asked.placement;
  const RecordFiles files = sort_record_inputs(asked.inputs);
  take_site(tool, {files.photons, files.source, files.radiance, asked.add_to}, asked.allow_mismatch);
  add_inputs(tool, files, asked.scene);
  if (!asked.at.empty()) tool.add_input("points", asked.at);
  if (!asked.add_to.empty()) tool.add_input("irradiance", asked.add_to);
  if (!placement.part.empty()) tool.set_variant("part " + placement.part);
  use_gl(tool, asked.gl);
  if (tool.up_to_date()) return;

  const Scene scene = load_scene(files.scene, asked.scene);
  tell_losses(tool, scene);
  const RecordInputs inputs = open_record_inputs(files, scene, asked.allow_mismatch);
  IrradianceCache cache;
  std::vector<LightWay> missed_before;
  if (!asked.add_to.empty()) cache = open_earlier(files, scene, tool.options(), asked, missed_before);
  cache.scene_hash = scene.hash;
  cache.quantity = records.paths;
  cache.caustics = caustics_of_run(inputs, scene, asked.add_to.empty() ? nullptr : &cache, asked.add_to);
  records.caustics_apart = cache.caustics != nullptr;
  if (cache.caustics) tool.stat("caustic_photons", cache.caustics->size());

  std::vector<SurfaceSample> points;
  if (!asked.at.empty()) points = read_points(asked.at, scene.origin_m);
  PlacementSource source{inputs.photons ? &*inputs.photons : nullptr, !asked.at.empty(), points, tool.seed()};
  resolve(placement, scene, source, records.accuracy);
  judge_placement(records, placement, tool.options());
  cache.accuracy = records.accuracy;
  const RayScene rays(scene, {asked.isa});
  if (const auto nested = nested_glass(rays)) tool.warn(*nested);
  tell_raster_light(tool, rays, records);
  if (placement.place == Place::view)
    if (const auto inside = camera_inside_solid(rays, find_camera(scene, placement.camera)))
      tool.warn(*inside);
  const TypicalDistance typical = typical_distance(rays, placement, source);
  tool.stat("typical_distance_m", typical.least_m);
  records.resolve(typical);
  if (!asked.at.empty() && of_photons_alone(records))
    source.points = points = require_surfaces(tool, rays, points, kOnSurface * typical.least_m, asked.at,
                                              "records of photons", "let rays gather: --estimate gather");
  const std::vector<LightWay> missed =
      tell_unsampled_kept(tool, asked.add_to, missed_before, tell_missed_ways(tool, rays, records));
  const auto provenance = [&] {
    Provenance own = tool.provenance(FileKind::irradiance, scene.hash, scene.parts);
    note_unsampled(own, missed);
    return own;
  };
  const ChosenEstimator estimator = [&] {
    const auto timer = tool.time("coarse records");
    return ChosenEstimator(rays, inputs, records, tool.seed());
  }();
  if (estimator.coarse_records() > 0) tool.stat("coarse_records", estimator.coarse_records());
  {
    const auto timer = tool.time("records");
    if (!placement.part.empty()) {
      const IrradiancePart part = make_part(cache, *estimator, rays, records, placement.part, points);
      return write_part(tool.output(), part, provenance());
    }
    const CoveredBy covered(cache, inputs.radiance);
    const PlacementReport report =
        extend_cache(cache, *estimator, rays, records, placement, source, tool.counters());
    covered.take_out(cache);
    summarise(tool, cache, report, missed.empty());
  }
  if (cache.records.empty()) {
    tool.warn(inputs.photons && inputs.photons->size() == 0
                  ? "there are no photons, and the file is empty: no light anywhere"
                  : "no place needs a record (see --place, --paths): the file is empty");
  }
  write_irradiance(tool.output(), cache, provenance());
}

}  // namespace phos::stage
