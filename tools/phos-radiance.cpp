// Places radiance records on glossy surfaces and estimates them.
#include <sstream>

#include "estimate/record_ways.h"
#include "file/tool.h"
#include "place/points_on_surfaces.h"
#include "place/radiance_placement.h"
#include "place/radiance_report.h"
#include "place/typical_distance.h"
#include "radiance/gloss_report.h"
#include "scene/load.h"
#include "splat/make_estimator.h"

using namespace phos;

namespace {

void tell_of_gloss(Tool& tool, const Json& report, bool projected_here) {
  tool.stat("gloss", report);
  std::istringstream lines(gloss_text(report));
  for (std::string line; std::getline(lines, line);) tool.say(line.substr(line.find_first_not_of(' ')));
  if (projected_here) tool.say("lobes were projected here; phos-brdf keeps them, and has options");
}

void summarise(Tool& tool, const RadianceCache& cache, const std::vector<RadianceRun>& runs) {
  const RadianceReport report = report_of(cache, runs);
  for (const auto& [name, figure] : report.figures.as_object()) tool.stat(name, figure);
  for (const std::string& line : report.lines) tool.say(line);
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("phos-radiance", "places radiance records on glossy surfaces and estimates them",
            "A radiance record holds the light that arrives from every direction, as hemispherical "
            "harmonics, with its standard error and gradients. Records are placed on materials whose lobes "
            "phos-brdf finds broad enough, each with the bands that its material needs, until each wanted "
            "place is within reach of one; other gloss is left to rays, and a scene without gloss gives an "
            "empty file. Inputs, in any order: a scene; photons of it, unless rays gather the first bounce "
            "only or read a cache; its .brdf file (else lobes are projected here); and caches for rays to "
            "read where they land: irradiance, in place of the coarse cache that is otherwise made from the "
            "photons, and radiance, for gloss.",
            17);
  tool.takes_strict();
  std::vector<std::string> paths;
  SceneOptions scene_options;
  RadianceOptions radiance;
  PlacementOptions placement;
  GlossBy gloss = GlossBy::automatic;
  std::string at, add_to, isa;
  bool allow_mismatch = false;
  Options& options = tool.options();
  options.inputs(
      "SCENE [PHOTONS] [BRDF] [CACHE]", paths,
      "scene (.glb, .gltf, .obj), photons of it, its .brdf file, irradiance and radiance caches to gather "
      "from");
  declare_options(options, scene_options);
  declare_options(options, gloss);
  declare_options(options, radiance);
  declare_place_options(options, placement);
  declare_isa(options, isa);
  options.file(
      "at", at,
      "CSV of points (x,y,z,nx,ny,nz) that need records, such as phos-splat --gloss-misses writes. A "
      "point off a surface by up to a tenth of the default --min-radius is put on it; one in free "
      "air is left out with a warning, and where all are, the end is code 3");
  options.file("add-to", add_to,
               "radiance file whose records are kept; options left out are taken from it; the "
               "output may be the same file",
               FileUse::grown);
  options.flag("allow-mismatch", allow_mismatch, "use files of another scene or another version of it");
  options.example("phos-radiance room.glb room.photons room.brdf -o room.radiance",
                  "where photons met gloss");
  options.example("phos-radiance room.glb room.photons room.brdf --place view --camera desk -o room.radiance",
                  "on the gloss that one camera sees");
  options.example(
      "phos-radiance room.glb room.photons room.brdf --at m.csv --add-to room.radiance -o room.radiance",
      "fills what a camera misses");

  return tool.run(argc, argv, [&] {
    const IrradianceFiles files = sort_inputs(paths);
    add_inputs(tool, files, scene_options);
    if (!at.empty()) tool.add_input("points", at);
    if (!add_to.empty()) tool.add_input("radiance", add_to);
    if (tool.up_to_date()) return;

    const Scene scene = load_scene(files.scene, scene_options);
    tell_losses(tool, scene);
    const EstimateInputs inputs = open_inputs(files, scene, allow_mismatch);
    const GlossTables tables = [&] {
      const auto timer = tool.time("tables");
      return GlossTables(scene, inputs.brdf, gloss, {}, tool.counters());
    }();
    RadianceCache cache;
    if (!add_to.empty()) {
      const Container earlier = open_to_add(add_to, "radiance", files, scene, allow_mismatch);
      adopt_options(radiance, options, earlier);
      cache = read_radiance(earlier);
      require_same_orders(cache, tables, add_to);
    }
    cache.accuracy = radiance.records.accuracy;
    cache.scene_hash = scene.hash;
    const IrradianceCache earlier = irradiance_of(cache);
    cache.caustics = caustics_of_run(inputs, scene, add_to.empty() ? nullptr : &earlier, add_to);
    radiance.records.caustics_apart = cache.caustics != nullptr;

    std::vector<SurfaceSample> points;
    if (!at.empty()) points = read_points(at, scene.origin_m);
    PlacementSource source{inputs.photons ? &*inputs.photons : nullptr, !at.empty(), points, tool.seed()};
    resolve(placement, scene, source, radiance.records.accuracy);
    const RayScene rays(scene, {isa});
    const TypicalDistance typical = typical_distance(rays, placement, source);
    tool.stat("typical_distance_m", typical.least_m);
    radiance.records.resolve(typical);
    std::vector<LightWay> missed;
    tell_of_gloss(tool, gloss_report(scene, tables), files.brdf.empty() && !tables.orders().empty());
    if (tables.orders().empty()) {
      tool.say(text(tables.choices().empty() ? "nothing glossy here" : "all gloss is traced by rays",
                    ": the file is empty"));
    } else {
      if (!at.empty())
        source.points = points = require_surfaces(tool, rays, points, kOnSurface * typical.least_m, at,
                                                  "radiance records", "let phos-sense read light there");
      missed = tell_missed_ways(tool, rays, radiance.records);
      const ChosenRadianceEstimators estimators = [&] {
        const auto timer = tool.time("coarse records");
        return ChosenRadianceEstimators(rays, inputs, radiance, tool.seed());
      }();
      if (estimators.coarse_records() > 0) tool.stat("coarse_records", estimators.coarse_records());
      const auto timer = tool.time("records");
      summarise(tool, cache,
                place_radiance(cache, tables, std::ref(estimators), rays, radiance.records, placement, source,
                               tool.counters()));
      if (cache.records.empty()) tool.warn("no place wants a record (see --place): the file is empty");
    }
    Provenance provenance = tool.provenance("radiance", scene.hash, scene.parts);
    note_unsampled(provenance, missed);
    write_radiance(tool.output(), cache, provenance);
  });
}
