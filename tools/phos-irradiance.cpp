// Places irradiance records and estimates them.
#include "estimate/record_ways.h"
#include "file/tool.h"
#include "place/parts.h"
#include "place/placement.h"
#include "place/points_on_surfaces.h"
#include "place/typical_distance.h"
#include "scene/inside_solid.h"
#include "scene/load.h"
#include "splat/make_estimator.h"

using namespace phos;

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
    throw Error(
        ExitCode::usage, "--placement-error",
        "is of gathered records with a circle for a footprint; give --estimate gather, or leave it out");
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

}  // namespace

int main(int argc, char** argv) {
  Tool tool(
      "phos-irradiance", "places irradiance records and estimates them from photons or rays",
      "Records are placed where photons landed, at given points, where a camera looks or on every surface, "
      "until "
      "each such place is within reach of one. A record holds the irradiance there with its standard error "
      "and "
      "gradients. Inputs, in any order: a scene; photons of it, unless rays gather the first bounce only or "
      "read a "
      "cache; an irradiance cache for rays to read where they land, in place of the coarse one that is "
      "otherwise made from the photons; and a radiance cache, for rays that land on gloss, whose records "
      "hold "
      "irradiance too, so that the surfaces which they cover get none of their own.",
      19);
  tool.takes_strict();
  std::vector<std::string> paths;
  SceneOptions scene_options;
  RecordOptions records;
  PlacementOptions placement;
  std::string at, add_to, isa;
  bool allow_mismatch = false;
  Options& options = tool.options();
  options.inputs(
      "SCENE [PHOTONS] [CACHE] [RADIANCE] [BRDF]", paths,
      "scene (.glb, .gltf, .obj), photons of it, a cache of it to gather from, radiance records of "
      "it and the .brdf file that they were made with");
  declare_options(options, scene_options);
  declare_options(options, records);
  declare_raster_options(options, records);
  declare_footprint_options(options, records);
  declare_options(options, placement);
  declare_isa(options, isa);
  options.file(
      "at", at,
      "CSV of points (x,y,z,nx,ny,nz) that need records, such as phos-splat --misses writes. Photons "
      "land on surfaces: --estimate hull and kernel put a point that is off a surface by up to a "
      "tenth of the default --min-radius on it, leave out one in free air with a warning, and end "
      "with code 3 where all are; gathered rays serve any point");
  options.file("add-to", add_to,
               "irradiance file whose records are kept; options left out are taken from it; the "
               "output may be the same file",
               FileUse::grown);
  options.flag("allow-mismatch", allow_mismatch, "use photons of another scene or another version of it");
  options.example("phos-irradiance room.glb room.photons -o room.irradiance",
                  "records where the photons are");
  options.example("phos-irradiance room.glb room.photons --estimate gather --rays 1024 -o room.irradiance",
                  "the same by rays, which read a coarse cache made from the photons: best quality");
  options.example(
      "phos-irradiance room.glb room.photons --at misses.csv --add-to room.irradiance -o room.irradiance",
      "fills what a camera misses");

  return tool.run(argc, argv, [&] {
    require_one_light(options);
    const IrradianceFiles files = sort_inputs(paths);
    add_inputs(tool, files, scene_options);
    if (!at.empty()) tool.add_input("points", at);
    if (!add_to.empty()) tool.add_input("irradiance", add_to);
    if (!placement.part.empty()) tool.set_variant("part " + placement.part);
    if (tool.up_to_date()) return;

    const Scene scene = load_scene(files.scene, scene_options);
    tell_losses(tool, scene);
    const EstimateInputs inputs = open_inputs(files, scene, allow_mismatch);
    IrradianceCache cache;
    if (!add_to.empty()) cache = open_earlier(add_to, files, scene, allow_mismatch, options, records);
    cache.scene_hash = scene.hash;
    cache.quantity = name_of(records.paths);
    cache.caustics = caustics_of_run(inputs, scene, add_to.empty() ? nullptr : &cache, add_to);
    records.caustics_apart = cache.caustics != nullptr;
    if (cache.caustics) tool.stat("caustic_photons", cache.caustics->size());

    std::vector<SurfaceSample> points;
    if (!at.empty()) points = read_points(at, scene.origin_m);
    PlacementSource source{inputs.photons ? &*inputs.photons : nullptr, !at.empty(), points, tool.seed()};
    resolve(placement, scene, source, records.accuracy);
    judge_placement(records, placement, options);
    cache.accuracy = records.accuracy;
    const RayScene rays(scene, {isa});
    if (placement.place == Place::view)
      if (const auto inside = camera_inside_solid(rays, find_camera(scene, placement.camera)))
        tool.warn(*inside);
    const TypicalDistance typical = typical_distance(rays, placement, source);
    tool.stat("typical_distance_m", typical.least_m);
    records.resolve(typical);
    if (!at.empty() && of_photons_alone(records))
      source.points = points = require_surfaces(tool, rays, points, kOnSurface * typical.least_m, at,
                                                "records of photons", "let rays gather: --estimate gather");
    const std::vector<LightWay> missed = tell_missed_ways(tool, rays, records);
    const auto provenance = [&] {
      Provenance own = tool.provenance("irradiance", scene.hash, scene.parts);
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
          place(cache, *estimator, rays, records, placement, source, tool.counters());
      covered.take_out(cache);
      summarise(tool, cache, report, missed.empty());
    }
    if (cache.records.empty()) {
      tool.warn(inputs.photons && inputs.photons->size() == 0
                    ? "there are no photons: the file is empty, which means no light anywhere"
                    : "no place wants a record (see --place, --paths): the file is empty");
    }
    write_irradiance(tool.output(), cache, provenance());
  });
}
