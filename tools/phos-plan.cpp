// phos-plan: scene + error or seconds -> the pipeline that gives it, as a script; or carried out.
#include <cstdio>

#include "core/parallel.h"
#include "file/tool.h"
#include "file/write_text.h"
#include "place/typical_distance.h"
#include "plan/direct.h"
#include "plan/options.h"
#include "plan/run.h"
#include "plan/text.h"
#include "plan/usual.h"
#include "radiance/gloss_report.h"
#include "scene/load.h"
#include "scene/picture.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(
      "phos-plan", "chooses the pipeline and its settings for an error or a time",
      text("Finds what the scene requires, makes a few small runs (the pilot) that tell noise from bias and "
           "fixed "
           "from growing times, and chooses the cheapest settings that meet the error, or the best that keep "
           "the "
           "time. Prints them as a shell script with the prediction and the reasons, or as JSON; --run "
           "carries "
           "them out, measures, and corrects them until the error is met or the time is spent. ",
           kErrorMeaning, " Predictions hold for this machine; times vary, and with them what is chosen."),
      1, Tool::Output::none);
  Options& options = tool.options();
  std::string scene_path;
  SceneOptions scene_options;
  PlanOptions plan;
  options.input("SCENE", scene_path, "glTF or OBJ scene");
  declare_options(options, plan);
  declare_options(options, scene_options);
  tool.takes_strict();
  options.example("phos-plan room.glb --error 5% --width 640 > plan.sh; bash plan.sh folder",
                  "a script, and its files");
  options.example("phos-plan room.glb --seconds 60 --json", "what can be had in a minute, for a program");
  options.example("phos-plan room.glb --error 3% --quantity lux --grid 0.5 --workplane 0.8 --run -o folder",
                  "lux on a workplane, measured until it is within 3 %");

  return tool.run(argc, argv, [&] {
    if (plan.run && !plan.output.empty())
      tool.writes("--output", plan.output, files_of_run(plan.points.empty()));
    const PlanGoal goal = goal_of(options, plan);
    PlanTask task = task_of(options, plan, scene_path, scene_options);
    tool.reads("scene", scene_files(scene_path, scene_options));
    const Scene scene = load_scene(scene_path, scene_options);
    tell_losses(tool, scene);
    Needs needs = plan_needs(
        scene, gloss_report(scene, GlossTables(scene, {}, GlossBy::automatic, {}, tool.counters())));
    if (!needs.lit)
      throw Error(ExitCode::bad_input, scene_path,
                  "has no light, so there is nothing to plan; give it a lamp or an --environment");
    task.gloss = needs.gloss, task.specular = needs.specular;
    task.by_photons = by_photons(plan.records, needs.ways, task, needs);
    if (task.image) {
      resolve_size(find_camera(scene, plan.camera), kPictureSide, task.width, task.height);
      const RayScene rays(scene);
      task.typical_m = typical_distance_m(rays, seen_places(rays, plan.camera));
    }
    add_portals(task, scene, needs);
    if (needs.animated && !options.given("frame") && !options.given("time"))
      tool.say(
          text("the scene is animated: this plan is for its start (see --frame); for all of it use "
               "phos-temporal --frames 0:",
               needs.frames - 1));

    PilotOptions piloted;
    piloted.seconds = plan.pilot_s, piloted.seed = tool.seed(),
    piloted.error = goal.error.value_or(plan.usual_error);
    if (!plan.run) piloted.most_seconds = std::max(3 * plan.pilot_s, 20.0);
    piloted.common = {"--threads", std::to_string(thread_count())};
    if (tool.verbose()) piloted.say = [&](const std::string& line) { tool.say(line); };
    const auto piloting = [&](const PlanTask& way) {
      const auto timer = tool.time("pilot");
      Pilot pilot = run_pilot(way, piloted);
      tool.say(
          text("pilot: took ", duration(pilot.seconds), way.cached_direct ? ", with --direct cached" : ""));
      return pilot;
    };
    if (plan.pilot_s > 0) tool.say(text("pilot: small runs, for about ", duration(piloted.seconds)));
    const auto [way, pilot, chosen] = plan_or_usual(task, goal, plan, count_lamps(scene), piloting, needs);
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
  });
}
