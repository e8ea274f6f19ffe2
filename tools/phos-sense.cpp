// phos-sense: scene, caches, points -> lux and its standard error at sensors.
#include <cstdio>
#include <limits>

#include "direct/direct_reader.h"
#include "file/atomic_file.h"
#include "file/mapped_file.h"
#include "file/tool.h"
#include "reference/measure_points.h"
#include "scene/load.h"
#include "scene/motion/film.h"
#include "scene/sky/daylight.h"
#include "sense/daylight_factor.h"
#include "sense/grid.h"
#include "sense/sensors.h"
#include "temporal/film/inputs.h"

using namespace phos;

namespace {

struct Inputs {
  std::vector<std::string> paths, caches;
  std::string scene, points, summary;

  void sort_out() {
    for (const std::string& path : paths) {
      require_bytes(path);
      if (is_container(path))
        caches.push_back(path);
      else if (!scene.empty())
        throw Error(ExitCode::usage, path, text("is no cache, and ", scene, " is the scene; give one scene"));
      else
        scene = path;
    }
    if (scene.empty())
      throw Error(ExitCode::usage, "", "no scene among the inputs; give the .glb, .gltf or .obj too");
  }
};

void check_usage(const Options& options, const Inputs& inputs, const SensorOptions& sense, bool exact) {
  if (exact && sense.direct_only)
    throw Error(ExitCode::usage, "--exact", "computes all light; leave out --direct-only");
  if ((exact || sense.direct_only) && !inputs.caches.empty())
    throw Error(ExitCode::usage, exact ? "--exact" : "--direct-only", "reads no cache; leave the caches out");
  for (const char* name : {"samples", "method"})
    if (!exact && options.given(name))
      throw Error(ExitCode::usage, text("--", name), "belongs to --exact; leave it out");
  if (!exact && options.given("error") && sense.light_samples)
    throw Error(ExitCode::usage, "--error", "chooses the number of shadow rays; leave out --light-samples");
  if ((exact || sense.direct_only) && !sense.sends_rays())
    throw Error(ExitCode::usage, "--light-samples", "of 0 leaves direct light to a cache; give 1 or more");
  if (inputs.caches.empty() && !exact && !sense.direct_only) {
    throw Error(
        ExitCode::usage, "",
        "no cache to read indirect light from: give one of phos-irradiance, or --exact, or --direct-only");
  }
}

void write_text(const std::string& path, std::span<const std::string> pieces) {
  AtomicFile file(path);
  for (const std::string& piece : pieces) file.write(piece);
  file.commit();
}

/// Of sensors whose records do not hold all light: those of files that say so, and those made here.
void leave_out_errors(Tool& tool, const std::vector<Container>& files, const std::vector<LightWay>& ways,
                      bool caustics, const SensorOptions& sense, const SensorReport& report,
                      std::vector<Reading>& readings) {
  const Sampler sampler = caustics ? Sampler::gathering_beside_caustics : Sampler::gathering;
  const bool by_files = !tell_unsampled_in(tool, files).empty();
  const auto rays = static_cast<double>(sense.rays);
  std::vector<LightWay> missed;
  if (report.uncovered > 0) missed = unsampled(ways, sampler, rays);
  tell_unsampled(tool, missed, sampler, rays,
                 text(report.uncovered, " sensors that no record of the caches reaches"));
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (report.is_covered(i) ? by_files : !missed.empty())
      readings[i].stderr_lx = std::numeric_limits<float>::quiet_NaN();
}

/// All light without caches.
std::vector<Reading> read_exactly(Tool& tool, const Sensors& sensors, const RayScene& rays,
                                  const Luminaires& lights, ReferenceMethod method,
                                  const std::vector<LightWay>& ways, const PointOptions& options,
                                  const SensorOptions& sense, SensorReport& report) {
  std::vector<SensorPoint> points;
  for (const SurfaceSample& p : sensors.points) points.push_back({p.position, p.normal});
  const MeasuredPoints measured = measure_points(rays, lights, points, method, ways, options);
  if (measured.rejected > 0) tool.counters().count("non-finite sample", measured.rejected);
  tool.counters().require_allowed("non-finite sample", measured.samples);
  measured.doubts.tell(tool);
  std::vector<Whole> whole;
  for (const PointIrradiance& e : measured.light)
    whole.push_back({e.illuminance_lx, e.illuminance_stderr_lx, e.irradiance_lx});
  return read_light_exactly(sensors, rays, lights, whole, sense, report);
}

void report_on(Tool& tool, const Inputs& inputs, const Sensors& sensors, std::span<const Reading> readings,
               const SensorReport& report, std::optional<double> open_lx) {
  Json summary = summarise(readings);
  if (open_lx) add_daylight_factors(summary, *open_lx);
  summary["misses"] = report.uncovered;
  summary["records_made"] = report.records_made;
  summary["sensors_inside_solids"] = report.inside;
  summary["sensors_outside"] = report.outside;
  summary["shadow_rays"] = report.shadow_rays;
  summary["sensors_above_error"] = report.above_error;
  summary["left_out"] = sensors.left_out;
  if (sensors.level_m) summary["level_m"] = *sensors.level_m;
  for (const auto& [name, value] : summary.as_object()) tool.stat(name, value);
  if (!inputs.summary.empty()) write_text(inputs.summary, {{summary.dump(2), "\n"}});
  tool.say(summary_line(summary));
  if (open_lx && !readings.empty()) tool.say(daylight_line(summary));
  if (sensors.left_out > 0)
    tool.say(text(sensors.left_out,
                  " points of the grid are left out: in solids, behind walls, near walls, or "
                  "with nothing below"));
  if (report.uncovered > 0)
    tool.say(text(report.uncovered, " sensors are beyond the caches' records; ", report.records_made,
                  " records were made for them"));
  if (report.above_error > 0)
    tool.say(
        text("direct light of ", report.above_error, " sensors is known less well than --error asks: pilots ",
             "foretell it roughly, and no lamp gets more than ", DirectReader::kMostRays,
             " rays (--light-samples can be more; --portals auto finds a sky behind windows with fewer)"));
  if (report.inside > 0) tool.warn(text(report.inside, " sensors are inside of solids or behind walls"));
  if (report.outside > 0) tool.warn(text(report.outside, " sensors are outside of the scene's bounds"));
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("phos-sense", "illuminance at sensor points, with its standard error",
            "Direct light comes from shadow rays, indirect light from irradiance and radiance caches; where "
            "these have no "
            "record (a workplane in free air) records are made by rays that read the caches. Writes CSV: "
            "id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx, to -o or stdout. With --bands all these "
            "are of "
            "the light in the triplet's bands, and band_K_of_N_lx follow, for phos-bands to join.",
            11, Tool::Output::optional);
  tool.takes_strict();
  tool.output_has_no_key();
  Inputs inputs;
  SceneOptions scene_options;
  GridOptions grid;
  SensorOptions sense;
  PointOptions exactly;
  ReferenceMethod method = ReferenceMethod::automatic;
  bool exact = false, allow_mismatch = false, factors = false;
  std::string isa;
  Options& options = tool.options();
  options.inputs("SCENE [CACHE]", inputs.paths,
                 "scene (.glb, .gltf, .obj), irradiance and radiance caches of it");
  declare_options(options, scene_options);
  tool.takes_frames(scene_options.frame);
  tool.fresh_each_frame(inputs);
  options.section("Sensors");
  options.file(
      "points", inputs.points,
      "sensors: CSV with the columns x,y,z,nx,ny,nz and perhaps id, or six numbers a line; - is stdin");
  declare_options(options, grid);
  options.section("Light");
  declare_options(options, sense);
  options.flag("exact", exact, "path tracing at each sensor instead of caches");
  options.integer("samples", exactly.samples, "N", "paths for each sensor with --exact, at most", {2, 1e12});
  options.number(
      "error", exactly.relative_error, "SHARE",
      "standard error to reach, relative to the illuminance: of direct light, by as many shadow rays as that "
      "takes, at most 4096 to each lamp (default: 0.01); with --exact of all light, where paths end before "
      "--samples (default: all of them)",
      kPositive);
  declare_method(
      options, method,
      "with --exact: path: from the sensor alone, which does not find what comes from small lamps by "
      "mirrors and glass; bidirectional: from sensor and lamps; auto: bidirectional where the scene "
      "has mirrors, smooth glass or sharp gloss");
  declare_isa(options, isa);
  options.flag(
      "daylight-factor", factors,
      "two more columns: E_lx and its standard error in percent of the illuminance in the open under "
      "the same sky (--sky overcast, by the norm; no sun, no lamps)",
      Recorded::if_given);
  options.file("summary", inputs.summary, "also write mean, least, greatest and uniformity there, as JSON",
               FileUse::written);
  options.flag("allow-mismatch", allow_mismatch, "use caches of another scene or another version of it");
  options.example("phos-sense room.glb room.irradiance --grid 0.5 --height 0.8 --margin 0.5 -o desk.csv",
                  "a workplane");
  options.example("phos-sense room.glb room.irradiance --points sensors.csv", "given points, to stdout");

  return tool.run(argc, argv, [&] {
    inputs.sort_out();
    inputs.summary = tool.frame_path(inputs.summary, "--summary");
    if (tool.frames() && inputs.points == "-")
      throw Error(ExitCode::usage, "--points", "stdin has no points for several frames; give a file");
    check_usage(options, inputs, sense, exact);
    check(grid, inputs.points);
    tool.add_input("scene", scene_files(inputs.scene, scene_options));
    const Scene scene = load_scene(inputs.scene, scene_options);
    tell_losses(tool, scene);
    if (const auto frames = tool.frames()) require_frames(scene, *frames);
    std::vector<Container> files;
    for (const std::string& path : inputs.caches) {
      files.push_back(Container::open(path));
      if (files.back().provenance().kind != "radiance") files.back() = Container::open(path, "irradiance");
      if (!allow_mismatch) require_same_scene(files.back(), inputs.scene, scene);
    }
    std::optional<double> open_lx;
    if (factors) open_lx = open_sky_lx(scene);
    if (factors && !is_overcast(scene_options.daylight))
      tool.warn("daylight factors are by the norm of an overcast sky (--sky overcast, cie:1 or cie:3)");
    const RayScene rays(scene, {isa});
    const Luminaires lights(scene);
    const Sensors sensors = find_sensors(inputs.points, grid, rays);
    if (sensors.points.empty()) tool.warn("there is no sensor: the output is a header alone");
    sense.seed = exactly.seed = tool.seed();
    sense.error = exactly.relative_error.value_or(sense.error);
    SensorReport report;
    const std::vector<LightWay> ways = sense.direct_only ? std::vector<LightWay>() : light_ways(rays, lights);
    std::vector<Reading> readings;
    bool caustics = false;
    {
      const auto timer = tool.time("read");
      const SensorCaches caches =
          sensor_caches_at(files, scene, sense.leak_test == LeakTest::ray ? &rays : nullptr);
      if (!sense.sends_rays() && !caches.holds_direct())
        throw Error(ExitCode::usage, "--light-samples",
                    text("of 0 leaves direct light to the cache, and ", inputs.caches[0],
                         " holds indirect light alone; make it with --direct cached"));
      caustics = caches.caustics() != nullptr;
      readings = exact ? read_exactly(tool, sensors, rays, lights, method, ways, exactly, sense, report)
                       : read_light(sensors, rays, lights, caches, sense, report);
    }
    tool.counters().merge(report.counters);
    if (!exact) leave_out_errors(tool, files, ways, caustics, sense, report, readings);
    const auto timer = tool.time("write");
    write_text(tool.output().empty() ? "/dev/stdout" : tool.output(),
               sensor_csv(sensors, readings, open_lx, scene.bands));
    report_on(tool, inputs, sensors, readings, report, open_lx);
  });
}
