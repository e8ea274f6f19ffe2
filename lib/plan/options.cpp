#include "plan/options.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "file/folder.h"
#include "plan/calibration.h"
#include "scene/limits.h"
#include "scene/opening/portals_about_rooms.h"
#include "scene/rays.h"

namespace phos::inline plan {

void declare_options(Options& options, PlanOptions& p) {
  using Of = PlanOptions::Of;
  options.section("Goal");
  options.text("error", p.error, "E", "largest error: 5% or 0.05");
  options.number("seconds", p.seconds, "S", "largest time of the pipeline, without the pilot; 0: no bound",
                 kNotNegative);
  options.choice<Of>("quantity", p.quantity, {{"image", Of::image}, {"lux", Of::lux}, {"both", Of::both}},
                     "wanted result: a picture, lux at sensors, or both");
  options.text("camera", p.camera, "NAME", "camera of the scene (default: the first one)");
  options.integer("width", p.width, "PIXELS",
                  "width of the picture; 0: from the height and the camera's aspect",
                  {0, kMostPictureSide.as<double>()});
  options.integer("height", p.height, "PIXELS",
                  "height of the picture; 0: from the width; both 0: 1000 on the longer side",
                  {0, kMostPictureSide.as<double>()});
  declare_frames(options, p.frames, Recorded::no);
  options.section("Sensors");
  options.file("sensors", p.points,
               "CSV with the columns x,y,z,nx,ny,nz in metres, and id where wanted, or six numbers a line");
  options.number("grid", p.grid.spacing_m, "METRES",
                 "instead of --sensors: distance between the points of a grid on a mesh or a workplane",
                 kPositive);
  options.text("mesh", p.grid.mesh, "NAME", "with --grid: node whose surfaces carry the grid");
  options.number("workplane", p.grid.height_m, "METRES",
                 "with --grid: height of a workplane that carries the grid, above the floor", kNotNegative);
  options.number("margin", p.grid.margin_m, "METRES",
                 "with --grid: least distance of the points to walls and edges", kNotNegative);
  options.choice<Axis>("up", p.grid.up, {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}},
                       "axis that points up, for a workplane; y in glTF");
  options.section("Plan");
  options.choice<PlanDirect>(
      "direct", p.direct,
      {{"auto", PlanDirect::automatic}, {"cached", PlanDirect::cached}, {"traced", PlanDirect::traced}},
      text("light straight from the lamps: cached: in the records; traced: by shadow rays; auto: tries both "
           "for a picture with ",
           calibration::kManyLamps,
           " lamps of an extent or more (the environment is one), runs the pilot twice, and keeps the "
           "records where they promise a third of the time or of the error"));
  options.choice<PlanGloss>(
      "gloss", p.gloss,
      {{"auto", PlanGloss::automatic}, {"cached", PlanGloss::cached}, {"traced", PlanGloss::traced}},
      text("gloss that harmonics hold: cached: by radiance records; traced: by rays; auto: tries both for a "
           "picture, runs the pilot twice, and keeps the records where they promise ",
           percent(calibration::kLeastGlossGain), " of the time or of the error, or less"));
  options.choice<PlanRecords>(
      "estimate", p.records,
      {{"auto", PlanRecords::automatic}, {"gather", PlanRecords::gather}, {"hull", PlanRecords::hull}},
      "method for the records: gather: rays that read a coarse cache; hull: the photons about a record; "
      "auto: hull where lamps light surfaces by mirrors, curved glass or sharp gloss so that rays would miss "
      "that light, else gather");
  options.choice<PlanFootprint>(
      "footprint", p.footprint,
      {{"auto", PlanFootprint::automatic},
       {"circle", PlanFootprint::circle},
       {"adaptive", PlanFootprint::adaptive}},
      text("zones of the records of a picture: circle: discs; adaptive: eight axes; auto: tries both, if "
           "records are gathered and take enough of the time or leave enough of the error, runs the pilot "
           "twice, and keeps adaptive zones where they promise ",
           percent(calibration::kLeastFootprintGain),
           " of the time or of the error, or less. Records that hold direct light have adaptive zones in "
           "any case"));
  options.number("pilot-seconds", p.pilot_s, "S",
                 "time of the pilot, about: half of this time goes into references, whose noise limits the "
                 "errors that the pilot can measure. Without --run, a pilot that takes more than three times "
                 "as long, and 20 s, is given up, and the plan has the settings that are usual for the "
                 "error. 0: no pilot, and the usual settings at once",
                 kNotNegative);
  options.flag("sh", p.script, "print a shell script (default, unless --json is given)");
  options.flag("json", p.json, "print JSON");
  options.file("output,o", p.output,
               "file of the plan (default: standard output); with --run, folder of all files",
               FileUse::written);
  options.section("Run");
  options.flag("run", p.run,
               "carry the plan out in the folder of -o, measure its error, and correct the settings until "
               "the error is met or the time is spent; exit code 1 if the error is not met");
  options.number("reference-seconds", p.reference_s, "S",
                 "with --run: time of the two references that measure the error; where they cannot tell "
                 "whether the error is met, better ones take three times as long; 0: the time of the "
                 "pipeline, or 60 if that is more",
                 kNotNegative);
  options.integer("rounds", p.rounds, "N", "with --run: largest number of runs of the pipeline", {1, 100});
}

double read_error(const std::string& word) {
  char* end = nullptr;
  double value = std::strtod(word.c_str(), &end);
  while (*end == ' ') ++end;
  const bool percent = *end == '%';
  if (percent) ++end, value /= 100;
  if (end == word.c_str() || *end != '\0' || !(std::isgreater(value, 0) && value <= 1))
    throw Error(ExitCode::usage, "--error",
                "\"" + word + "\" is not an error; give a share between 0 and 100 %, like 5% or 0.05");
  return value;
}

PlanGoal goal_of(const Options& options, const PlanOptions& p) {
  PlanGoal goal;
  if (options.given("error")) goal.error = read_error(p.error);
  if (p.seconds > 0) goal.seconds = p.seconds;
  if (!goal.error && !goal.seconds)
    throw Error(ExitCode::usage, "", "no goal is given; give --error 5% or --seconds 60");
  if (options.given("frames")) {
    const auto refuse = [](const char* what, const char* why) { throw Error(ExitCode::usage, what, why); };
    parse_frames(p.frames);
    if (!goal.error || goal.seconds)
      refuse("--seconds",
             "does not go with --frames: the time of a film depends on how its light changes; give --error");
    if (p.run) refuse("--run", "measures one picture, not a film; leave it out, and run the script");
    for (const char* name : {"frame", "time"})
      if (options.given(name))
        refuse("--frames", "plans a film, and --frame or --time one picture; give one");
    if (p.direct == PlanDirect::cached)
      refuse("--direct", "cached is for one picture: records of a film hold indirect light; leave it out");
    if (p.quantity != PlanOptions::Of::image)
      refuse("--quantity", "of a film is image: phos-sense --frames reads lux; leave it out");
  }
  if (p.json && p.script) throw Error(ExitCode::usage, "--json", "and --sh exclude each other; give one");
  if (p.run && p.output.empty())
    throw Error(ExitCode::usage, "--run", "needs a folder for its files: -o folder");
  if (p.run) check_folder(p.output);
  if (p.run && (p.json || p.script))
    throw Error(ExitCode::usage, "--run",
                "writes plan.sh and plan.json into its folder; leave out --sh and --json");
  if (p.run && !(p.pilot_s > 0))
    throw Error(
        ExitCode::usage, "--pilot-seconds",
        "0 makes no pilot, by which --run corrects the settings; leave out --run, or give some seconds");
  for (const char* name : {"reference-seconds", "rounds"})
    if (!p.run && options.given(name))
      throw Error(ExitCode::usage, text("--", name), "needs --run; give --run, or leave it out");
  return goal;
}

PlanTask task_of(const Options& options, const PlanOptions& p, const std::string& scene,
                 const SceneOptions& scene_options) {
  const GridOptions& grid = p.grid;
  PlanTask task;
  task.scene = scene;
  const auto add = [](std::vector<std::string>& words, const char* name, const std::string& value) {
    words.insert(words.end(), {name, value});
  };
  std::vector<std::string>& words = task.scene_words;
  if (scene_options.time_s) add(words, "--time", shortest(*scene_options.time_s));
  if (scene_options.frame) add(words, "--frame", shortest(*scene_options.frame));
  if (!scene_options.environment.empty()) add(words, "--environment", scene_options.environment);
  if (scene_options.environment_rotation_deg)
    add(words, "--environment-rotation", shortest(*scene_options.environment_rotation_deg));
  if (scene_options.environment_scale)
    add(words, "--environment-scale", shortest(*scene_options.environment_scale));
  for (const std::string& word : daylight_words(scene_options.daylight)) words.push_back(word);
  if (!scene_options.portals.empty()) add(words, "--portals", scene_options.portals);
  if (!scene_options.lamps.empty()) add(words, "--lamps", scene_options.lamps);
  for (const std::string& word : luminaire_words(scene_options.luminaires)) words.push_back(word);
  for (const std::string& word : band_words(scene_options.bands)) words.push_back(word);
  if (!p.frames.empty()) task.frames = parse_frames(p.frames);
  task.image = p.quantity != PlanOptions::Of::lux, task.lux = p.quantity != PlanOptions::Of::image;
  if (task.lux && p.direct == PlanDirect::cached)
    throw Error(ExitCode::usage, "--direct",
                "cached is for pictures: sensors always send shadow rays; leave it out");
  if (p.gloss == PlanGloss::cached && (task.lux || p.direct == PlanDirect::cached))
    throw Error(ExitCode::usage, "--gloss",
                text("cached does not go with ", task.lux ? "sensors, which see no gloss" : "--direct cached",
                     "; leave one of them out"));
  if (p.footprint == PlanFootprint::adaptive && (task.lux || p.records == PlanRecords::hull))
    throw Error(ExitCode::usage, "--footprint",
                text("adaptive ",
                     task.lux ? "is for pictures: each sensor has a record of its own"
                              : "does not go with --estimate hull: adaptive zones need gathered rays",
                     "; leave it out"));
  for (const char* name : {"camera", "width", "height"})
    if (!task.image && options.given(name))
      throw Error(ExitCode::usage, text("--", name),
                  "belongs to a picture; leave it out, or give --quantity both");
  for (const char* name : {"sensors", "grid", "mesh", "workplane", "margin", "up"})
    if (!task.lux && options.given(name))
      throw Error(ExitCode::usage, text("--", name), "places sensors; give --quantity lux or both too");
  task.camera = p.camera, task.width = p.width, task.height = p.height;
  if (!task.lux) return task;
  if (p.points.empty() && !grid.spacing_m)
    throw Error(
        ExitCode::usage, "--quantity",
        "lux is measured at sensors: give --sensors points.csv, or --grid with --workplane or --mesh");
  if (!p.points.empty() && grid.spacing_m)
    throw Error(ExitCode::usage, "--sensors", "and --grid exclude each other; give one");
  if (grid.spacing_m && grid.mesh.empty() == !grid.height_m)
    throw Error(ExitCode::usage, "--grid",
                "lies either on --workplane METRES or on --mesh NAME; give one of them");
  task.points = p.points;
  if (!p.points.empty()) return task;
  add(task.grid, "--grid", shortest(*grid.spacing_m));
  if (!grid.mesh.empty()) add(task.grid, "--mesh", grid.mesh);
  if (grid.height_m) add(task.grid, "--height", shortest(*grid.height_m));
  if (grid.margin_m > 0) add(task.grid, "--margin", shortest(grid.margin_m));
  if (grid.up != Axis::y) add(task.grid, "--up", grid.up == Axis::x ? "x" : "z");
  return task;
}

void add_portals(PlanTask& task, const Scene& scene, Needs& needs) {
  constexpr const char* kPortals = "portals";
  if (!scene.environment || !scene.portal.empty()) return;
  const std::size_t found = portals_about_rooms(RayScene(scene)).size();
  if (found == 0)
    return needs.unwanted.push_back({kPortals, "the light from outside comes by no opening of a room"});
  needs.wanted.push_back({kPortals, text("light from outside comes by ", found, " openings of rooms")});
  task.scene_words.insert(task.scene_words.end(), {"--portals", "auto"});
}

}  // namespace phos::inline plan
