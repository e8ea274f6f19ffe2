// Places radiance records on glossy surfaces and estimates them.
#include <cmath>
#include <sstream>

#include "cache/gloss_report.h"
#include "cache/radiance_placement.h"
#include "file/tool.h"
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
  PlacementReport all;
  double open_share = 0;
  Json by_order = Json::Array{};
  for (const RadianceRun& run : runs) {
    const PlacementReport& r = run.report;
    all.made += r.made, all.kept += r.kept, all.making_s += r.making_s;
    all.candidates += r.candidates, all.uncovered += r.uncovered;
    Json j;
    j["order"] = run.order, j["records_new"] = r.kept, j["records_made"] = r.made;
    j["candidates"] = r.candidates, j["candidates_uncovered"] = r.uncovered, j["passes"] = r.passes;
    if (r.uncovered_share) j["uncovered_share"] = *r.uncovered_share;
    open_share = std::max(open_share, r.uncovered_share.value_or(0));
    by_order.push_back(j);
  }
  const RadianceSummary summary = summarize(cache);
  const double ms = all.made > 0 ? 1e3 * all.making_s / static_cast<double>(all.made) : 0;
  tool.stat("records", cache.records.size());
  tool.stat("records_new", all.kept);
  tool.stat("records_made", all.made);
  tool.stat("runs", by_order);
  tool.stat("relative_error", summary.error);
  if (all.made > 0) tool.stat("ms_per_record", ms);
  std::string orders;
  for (const auto& [order, count] : summary.records)
    orders += text(orders.empty() ? "" : ", ", count, " of order ", order);
  const auto rounded = [](double v) { return std::round(100 * v) / 100; };
  tool.say(text("records: ", orders.empty() ? "none" : orders, "; ", all.kept, " new, for ", all.candidates,
                " candidates", all.made > 0 ? text(", ", rounded(ms), " ms each") : "",
                "; mean standard error ", rounded(100 * summary.error), " % of the light"));
  if (open_share > 0)
    tool.say(text(rounded(100 * open_share), " % of the glossy surface is out of every record's reach"));
  else if (all.uncovered > 0)
    tool.say(text(all.uncovered, " candidates are left uncovered by neighbour clamping; raise --passes"));
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
            1);
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
  options.file("at", at,
               "CSV of points (x,y,z,nx,ny,nz) that need records, such as phos-splat --gloss-misses writes");
  options.file("add-to", add_to, "radiance file whose records are kept; options left out are taken from it");
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
    tool.add_input("scene", scene_files(files.scene, scene_options));
    if (!files.photons.empty()) tool.add_input("photons", files.photons);
    if (!files.brdf.empty()) tool.add_input("brdf", files.brdf);
    if (!files.source.empty()) tool.add_input("source", files.source);
    if (!files.radiance.empty()) tool.add_input("gloss", files.radiance);
    if (!at.empty()) tool.add_input("points", at);
    if (!add_to.empty()) tool.add_input("radiance", add_to);
    if (tool.up_to_date()) return;

    const Scene scene = load_scene(files.scene, scene_options);
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
    radiance.records.resolve(scene.bounds.diagonal_m());
    cache.accuracy = radiance.records.accuracy;
    cache.scene_hash = scene.hash;

    std::vector<SurfaceSample> points;
    if (!at.empty()) points = read_points(at);
    const PlacementSource source{inputs.photons ? &*inputs.photons : nullptr, !at.empty(), points,
                                 tool.seed()};
    resolve(placement, scene, source);
    tell_of_gloss(tool, gloss_report(scene, tables), files.brdf.empty() && !tables.orders().empty());
    if (tables.orders().empty()) {
      tool.say(text(tables.choices().empty() ? "nothing glossy here" : "all gloss is traced by rays",
                    ": the file is empty"));
    } else {
      const RayScene rays(scene, {isa});
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
    write_radiance(tool.output(), cache, tool.provenance("radiance", scene.hash, scene.parts));
  });
}
