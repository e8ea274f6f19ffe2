#include "stage/sense.h"

#include <limits>

#include "direct/direct_reader.h"
#include "file/atomic_file.h"
#include "file/shards.h"
#include "reference/events.h"
#include "reference/measure_points.h"
#include "scene/motion/film.h"
#include "scene/nested_glass.h"
#include "scene/sky/daylight.h"
#include "sense/daylight_factor.h"
#include "sense/sensor_table.h"
#include "stage/inputs.h"
#include "stage/site.h"
#include "temporal/film/inputs.h"

namespace phos::stage {
namespace {

void check_usage(const Options& options, const InputFiles& files, const SenseCommand& asked) {
  const SensorOptions& sense = asked.sense;
  const bool exact = asked.exact;
  if (exact && sense.direct_only)
    throw Error(ExitCode::usage, "--exact", "computes all light; leave out --direct-only");
  if ((exact || sense.direct_only) && !files.phos.empty())
    throw Error(ExitCode::usage, exact ? "--exact" : "--direct-only", "reads no cache; leave the caches out");
  for (const char* name : {"samples", "method"})
    if (!exact && options.given(name))
      throw Error(ExitCode::usage, text("--", name), "needs --exact; give --exact, or leave it out");
  if (!exact && options.given("error") && sense.light_samples)
    throw Error(ExitCode::usage, "--error", "chooses the number of shadow rays; leave out --light-samples");
  if (!asked.part.empty()) {
    parse_share("--part", asked.part);
    if (exact) throw Error(ExitCode::usage, "--part", "is of readings of caches; leave out --exact");
    if (!asked.summary.empty())
      throw Error(ExitCode::usage, "--summary", "would be of a part of the sensors; leave out --part");
  }
  if ((exact || sense.direct_only) && !sense.sends_rays())
    throw Error(ExitCode::usage, "--light-samples", "of 0 leaves direct light to a cache; give 1 or more");
  if (files.phos.empty() && !exact && !sense.direct_only) {
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

/// Leaves part "k/n" of the sensors, and their numbers.
void keep_part(Sensors& sensors, const std::string& part) {
  const ItemRange range = range_of(parse_share("--part", part), sensors.points.size());
  const auto keep = [&](auto& all) {
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(range.first + range.count), all.end());
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(range.first));
  };
  keep(sensors.points);
  if (!sensors.ids.empty()) keep(sensors.ids);
  sensors.first = range.first;
}

/// Sensors whose records do not hold all light: records of files that say so, and records made here.
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
                                  const Luminaires& lights, const SenseCommand& asked,
                                  const std::vector<LightWay>& ways, SensorReport& report) {
  std::vector<SensorPoint> points;
  for (const SurfaceSample& p : sensors.points) points.push_back({p.position, p.normal});
  const MeasuredPoints measured = measure_points(rays, lights, points, asked.method, ways, asked.exactly);
  if (measured.rejected > 0) tool.counters().count(kNonFiniteSampleEvent, measured.rejected);
  tool.counters().require_allowed(kNonFiniteSampleEvent, measured.samples);
  measured.doubts.tell(tool);
  std::vector<Whole> whole;
  for (const PointIrradiance& e : measured.light)
    whole.push_back({e.illuminance_lx, e.illuminance_stderr_lx, e.irradiance_lx});
  return read_light_exactly(sensors, rays, lights, whole, asked.sense, report);
}

void report_on(Tool& tool, const std::string& summary_path, const Sensors& sensors,
               std::span<const Reading> readings, const SensorReport& report, std::optional<double> open_lx) {
  Json summary = summarise(readings);
  if (open_lx) add_daylight_factors(summary, *open_lx);
  summary["misses"] = report.uncovered;
  summary["records_made"] = report.records_made;
  summary["sensors_inside_solids"] = report.inside.size();
  summary["sensors_outside"] = report.outside;
  summary["shadow_rays"] = report.shadow_rays;
  summary["sensors_above_error"] = report.above_error;
  summary["left_out"] = sensors.left_out;
  if (sensors.level_m) summary["level_m"] = *sensors.level_m;
  for (const auto& [name, value] : summary.as_object()) tool.stat(name, value);
  if (!summary_path.empty()) write_text(summary_path, {{summary.dump(2), "\n"}});
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
             "predict it roughly, and no lamp gets more than ", DirectReader::kMostRays,
             " rays (--light-samples can be more; --portals auto finds a sky behind windows with fewer)"));
  if (!report.inside.empty())
    tool.warn(text(report.inside.size(),
                   " sensors are inside of solids or behind walls (the first is number ",
                   sensors.first + report.inside[0], "): no standard error is stated for them"));
  if (report.outside > 0) tool.warn(text(report.outside, " sensors are outside of the scene's bounds"));
}

}  // namespace

void run(Tool& tool, SenseCommand& asked) {
  const InputFiles inputs = sort_inputs(asked.inputs, Beside::caches);
  const std::string summary = tool.frame_path(asked.summary, "--summary");
  if (tool.frames() && asked.points == "-")
    throw Error(ExitCode::usage, "--points", "stdin has no points for several frames; give a file");
  check_usage(tool.options(), inputs, asked);
  check(asked.grid, asked.points);
  take_site(tool, inputs.phos, asked.allow_mismatch);
  tool.add_input("scene", scene_files(inputs.scene, asked.scene));
  const Scene scene = load_scene(inputs.scene, asked.scene);
  tell_losses(tool, scene);
  if (const auto frames = tool.frames()) require_frames(scene, *frames);
  const std::vector<Container> files = open_caches(inputs.phos, CacheKinds::records);
  require_together(files, inputs.scene, scene, asked.allow_mismatch);
  std::optional<double> open_lx;
  if (asked.factors) open_lx = open_sky_lx(scene);
  if (asked.factors && !is_overcast(asked.scene.daylight))
    tool.warn(
        "daylight factors are defined under an overcast sky; give --sky overcast, cie:1 or cie:3 for "
        "standard ones");
  const RayScene rays(scene, {asked.isa});
  const Luminaires lights(scene);
  if (const auto nested = nested_glass(rays)) tool.warn(*nested);
  Sensors sensors = find_sensors(asked.points, asked.grid, rays);
  if (!asked.part.empty()) keep_part(sensors, asked.part);
  if (sensors.points.empty()) tool.warn("there is no sensor, and the output is a header alone");
  SensorOptions& sense = asked.sense;
  sense.whole_run = asked.part.empty();
  sense.seed = asked.exactly.seed = tool.seed();
  sense.error = asked.exactly.relative_error.value_or(sense.error);
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
                  text("of 0 leaves direct light to the cache, and ", inputs.phos[0],
                       " holds indirect light alone; make it with --direct cached"));
    caustics = caches.caustics() != nullptr;
    readings = asked.exact ? read_exactly(tool, sensors, rays, lights, asked, ways, report)
                           : read_light(sensors, rays, lights, caches, sense, report);
  }
  tool.counters().merge(report.counters);
  if (!asked.exact) leave_out_errors(tool, files, ways, caustics, sense, report, readings);
  for (const std::size_t i : report.inside) readings[i].stderr_lx = std::numeric_limits<float>::quiet_NaN();
  const auto timer = tool.time("write");
  write_text(tool.output().empty() ? "/dev/stdout" : tool.output(),
             sensor_csv(sensors, readings, open_lx, scene.bands));
  report_on(tool, summary, sensors, readings, report, open_lx);
}

}  // namespace phos::stage
