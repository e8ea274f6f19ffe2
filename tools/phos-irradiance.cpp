// Places irradiance records and estimates them from photons.
#include "cache/placement.h"
#include "cache/record_maker.h"
#include "file/hash.h"
#include "file/tool.h"
#include "scene/load.h"

using namespace phos;

namespace {

struct Inputs {
  std::vector<std::string> paths;
  std::string scene, photons;

  /// Tells scene and photons apart by their contents.
  void sort_out() {
    if (paths.size() != 2) throw Error(ExitCode::usage, "", "give two inputs, a scene and its photons");
    const bool first = is_container(paths[0]), second = is_container(paths[1]);
    if (first && second)
      throw Error(ExitCode::usage, "", "no scene among the inputs; give the .glb, .gltf or .obj too");
    if (!first && !second) {
      hash_file(paths[0]), hash_file(paths[1]);  // a missing file is said to be missing
      throw Error(ExitCode::usage, "", "no photons among the inputs; give the output of phos-photons too");
    }
    scene = paths[first ? 1 : 0], photons = paths[first ? 0 : 1];
  }
};

std::string percent(double part, double whole) {
  std::ostringstream out;
  out.precision(2);
  out << 100 * part / whole << " %";
  return out.str();
}

void summarise(Tool& tool, const IrradianceCache& cache, const PlacementReport& report) {
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
                light > 0 ? "; mean standard error " + percent(error, light) : ""));
  if (report.uncovered > 0) {
    tool.say(text(report.uncovered,
                  " candidates are left uncovered by neighbour clamping; raise --passes to cover them"));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("phos-irradiance", "places irradiance records and estimates them from photons",
            "Records are placed where photons landed, or at given points, until each is within reach of one. "
            "A record holds "
            "the irradiance there with its standard error and gradients. Inputs are a scene and its photons, "
            "in any order.",
            1);
  Inputs inputs;
  SceneOptions scene_options;
  RecordOptions records;
  PlacementOptions placement;
  std::string at, add_to, isa;
  bool allow_mismatch = false;
  Options& options = tool.options();
  options.inputs("SCENE PHOTONS", inputs.paths, "scene (.glb, .gltf, .obj) and photons of it");
  declare_options(options, scene_options);
  declare_options(options, records);
  declare_options(options, placement);
  declare_isa(options, isa);
  options.file("at", at,
               "CSV of points (x,y,z,nx,ny,nz) that need records, such as phos-splat --misses writes");
  options.file("add-to", add_to,
               "irradiance file whose records are kept; options left out are taken from it");
  options.flag("allow-mismatch", allow_mismatch, "use photons of another scene or another version of it");
  options.example("phos-irradiance room.glb room.photons -o room.irradiance",
                  "records where the photons are");
  options.example(
      "phos-irradiance room.glb room.photons --at misses.csv --add-to room.irradiance -o room.irradiance",
      "fills what a camera misses");

  return tool.run(argc, argv, [&] {
    inputs.sort_out();
    tool.add_input("scene", scene_files(inputs.scene));
    tool.add_input("photons", inputs.photons);
    if (!at.empty()) tool.add_input("points", at);
    if (!add_to.empty()) tool.add_input("irradiance", add_to);
    if (tool.up_to_date()) return;

    const Scene scene = load_scene(inputs.scene, scene_options);
    const PhotonMap photons = PhotonMap::open(inputs.photons);
    if (!allow_mismatch) require_same_scene(*photons.container(), inputs.scene, scene.hash, scene.parts);
    IrradianceCache cache;
    if (!add_to.empty()) {
      const Container earlier = Container::open(add_to, "irradiance");
      if (!allow_mismatch) {
        require_same_scene(earlier, inputs.scene, scene.hash, scene.parts);
        const auto source = earlier.provenance().inputs.find("photons");
        if (source != earlier.provenance().inputs.end() &&
            source->second != hash_file(inputs.photons).hex()) {
          throw Error(ExitCode::mismatch, add_to,
                      "was made from other photons; give those, or pass --allow-mismatch to mix the two");
        }
      }
      adopt_options(records, options, earlier);
      cache = read_irradiance(earlier);
    }
    records.resolve(scene.bounds.diagonal_m());
    cache.accuracy = records.accuracy;
    cache.scene_hash = scene.hash;
    cache.quantity = records.paths == Quantity::all ? "all" : "indirect";

    std::vector<SurfaceSample> points;
    if (!at.empty()) points = read_points(at);
    const RayScene rays(scene, {isa});
    PlacementReport report;
    {
      const auto timer = tool.time("records");
      const RecordMaker maker(photons, rays, records, tool.seed());
      report = place_records(
          cache, maker, rays, records, placement,
          at.empty() ? photon_candidates(photons, records.paths, tool.seed(), placement.max_candidates)
                     : point_candidates(points),
          tool.counters());
      summarise(tool, cache, report);
    }
    if (cache.records.empty()) {
      tool.warn(photons.size() == 0
                    ? "there are no photons: the file is empty, which means no light anywhere"
                    : "no photon counts (see --paths): the file is empty, which means no such light");
    }
    write_irradiance(tool.output(), cache, tool.provenance("irradiance", scene.hash, scene.parts));
  });
}
