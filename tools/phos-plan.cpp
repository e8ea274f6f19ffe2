// phos-plan: chooses the pipeline and its settings for an error or a time.
#include "stage/plan.h"

#include "plan/text.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-plan"),
            text("Finds the stages that the scene requires, makes a few small runs (the pilot) that tell "
                 "noise from bias and fixed from growing times, and chooses the cheapest settings that meet "
                 "the error, or the best settings within the time. Prints them as a shell script with the "
                 "prediction and the reasons, or as JSON; --run carries them out, measures the error, and "
                 "corrects the settings until the error is met or the time is spent. ",
                 kErrorMeaning,
                 " Predictions hold for this machine; times vary, and the chosen settings with them."),
            stage::kPlanAlgorithm, Tool::Output::none);
  Options& options = tool.options();
  stage::PlanCommand asked;
  options.input("SCENE", asked.scene_path, "glTF or OBJ scene");
  declare_options(options, asked.plan);
  declare_options(options, asked.scene);
  tool.takes_strict();
  options.example("phos-plan room.glb --error 5% --width 640 > plan.sh; bash plan.sh folder",
                  "a script, and its run in a folder");
  options.example("phos-plan room.glb --seconds 60 --json",
                  "the best picture within a minute, as JSON for a program");
  options.example("phos-plan room.glb --error 3% --quantity lux --grid 0.5 --workplane 0.8 --run -o folder",
                  "lux on a workplane, measured until it is within 3 %");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
