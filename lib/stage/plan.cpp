#include "stage/plan.h"

#include <algorithm>

#include "core/parallel.h"
#include "file/write_text.h"
#include "place/typical_distance.h"
#include "plan/calibration.h"
#include "plan/film.h"
#include "plan/json.h"
#include "plan/run.h"
#include "plan/text.h"
#include "plan/usual.h"
#include "plan/way/direct.h"
#include "radiance/gloss_report.h"
#include "scene/picture.h"

namespace phos::stage {
void run(Tool& tool, const PlanCommand& asked) {
  const PlanOptions& plan = asked.plan;
  const Options& options = tool.options();
  if (plan.run && !plan.output.empty())
    tool.writes("--output", plan.output, files_of_run(plan.points.empty()));
  const PlanGoal goal = goal_of(options, plan);
  PlanTask task = task_of(options, plan, asked.scene_path, asked.scene);
  tool.reads("scene", scene_files(asked.scene_path, asked.scene));
  SceneOptions at_start = asked.scene;
  if (task.frames) at_start.frame = static_cast<double>(task.frames->first);
  const Scene scene = load_scene(asked.scene_path, at_start);
  tell_losses(tool, scene);
  Needs needs =
      plan_needs(scene, gloss_report(scene, GlossTables(scene, {}, GlossBy::automatic, {}, tool.counters())),
                 task.frames.has_value());
  if (!needs.lit)
    throw Error(ExitCode::bad_input, asked.scene_path,
                "has no light, so there is nothing to plan; give it a lamp or an --environment");
  if (task.frames && !needs.animated)
    throw Error(ExitCode::usage, "--frames", "the scene is not animated; leave it out");
  if (goal.error)
    task.temporal_accuracy = std::min(calibration::kMostFilmChange, calibration::kFilmChange * *goal.error);
  task.gloss = needs.gloss, task.specular = needs.specular;
  task.by_photons = by_photons(plan.records, needs.ways, task, needs);
  if (task.image) {
    resolve_size(find_camera(scene, plan.camera), kPictureSide, task.width, task.height);
    const RayScene rays(scene);
    task.typical_m = typical_distance_m(rays, seen_places(rays, plan.camera));
  }
  add_portals(task, scene, needs);
  if (needs.animated && !task.frames && !options.given("frame") && !options.given("time"))
    tool.say(text(
        "the scene is animated: this plan is for its start (see --frame); for all of it give --frames 0:",
        needs.frames - 1));

  PilotOptions piloted;
  piloted.seconds = plan.pilot_s, piloted.seed = tool.seed(),
  piloted.error = goal.error.value_or(plan.usual_error);
  if (!plan.run) piloted.most_seconds = std::max(3 * plan.pilot_s, 20.0);
  piloted.common = {"--threads", std::to_string(thread_count())};
  if (tool.verbose()) piloted.say = [&](const std::string& line) { tool.say(line); };
  const auto piloting = [&](const PlanTask& way) {
    const auto timer = tool.time("pilot");
    Pilot pilot = run_pilot(still_of(way), piloted);
    stretch_to_film(pilot.time, way);
    tool.say(text("pilot: took ", duration(pilot.seconds),
                  way.cached_direct  ? ", with --direct cached"
                  : way.cached_gloss ? ", with --gloss cached"
                                     : "",
                  way.adaptive ? ", with --footprint adaptive" : ""));
    return pilot;
  };
  if (plan.pilot_s > 0) tool.say(text("pilot: small runs, for about ", duration(piloted.seconds)));
  auto [way, pilot, chosen] = plan_or_usual(task, goal, plan, count_lamps(scene), piloting, needs);
  if (task.frames)
    chosen.warnings.push_back(
        text("the error is of the first frame; records that live through frames may miss changes of ",
             percent(task.temporal_accuracy), " of their light beside it"));
  if (task.frames && chosen.predicted)
    chosen.warnings.push_back(text("the time of the film is a guess, for light that is computed at ",
                                   percent(calibration::kFilmLight), " of the frames"));
  if (chosen.predicted) tool.say(prediction_line(chosen.chosen));
  for (const std::string& warning : chosen.warnings) tool.say(warning);
  if (!plan.run && !pilot.doubts.empty()) tool.set_exit(ExitCode::numerical);
  if (!plan.run)
    return write_text(plan.output.empty() ? "/dev/stdout" : plan.output,
                      plan.json ? plan_json(way, needs, pilot, goal, chosen, tool.seed()).dump(2) + "\n"
                                : plan_script(way, needs, pilot, goal, chosen, tool.seed()));

  PlanRunOptions run;
  run.folder = plan.output, run.seed = tool.seed(), run.common = piloted.common;
  run.reference_seconds = plan.reference_s, run.rounds = static_cast<int>(plan.rounds);
  run.say = [&](const std::string& line) { tool.say(line); };
  const PlanReport report = run_plan(way, needs, pilot, goal, chosen, run);
  if (report.met) return tool.say(report.verdict);
  tool.warn(report.verdict);
  tool.set_exit(ExitCode::check_failed);
}

}  // namespace phos::stage
