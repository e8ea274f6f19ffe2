// phos-study: measures the time and the error of settings.
#include "stage/study.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(
      program("phos-study"),
      "Runs the stages that a study file (TOML) names, with every combination of the values that it lists, "
      "and judges pictures and lux against a reference. Sections [photons], [brdf], [radiance], "
      "[irradiance], [temporal], [splat] and [sense] hold options of the programs of these names: a value, a "
      "list of values, or a range { from = 0.05, to = 0.4, steps = 4, scale = \"log\" }; [common] holds "
      "options of all programs; camera = \"each\" before phos-splat means each camera of the study in turn. "
      "[study] has scenes, cameras, seeds (or repeats), sensors, layer, ignore_lamps, width and height (of "
      "pictures, and of views that records are placed for), threads, time (wall or cpu) and confidence. "
      "[reference] has options of phos-reference, seeds (two, so that the noise of the reference can be "
      "taken out) and sensor_samples; or files and lux that exist already, for several views as "
      "[[reference.given]] with scene and camera. Stages that settings share run once; finished stages are "
      "not run again, and an interrupted study goes on where it was. The folder gets results.csv, "
      "results.json, plots and index.html, a page that needs no other file.",
      stage::kStudyAlgorithm, Tool::Output::none);
  stage::StudyCommand asked;
  StudyOptions& study = asked.study;
  Options& options = tool.options();
  options.input("STUDY", study.file, "study file (TOML)");
  options.file("output,o", study.folder,
               "folder for the results, and for the files from which an interrupted study goes on",
               FileUse::folder, true);
  options.integer("pictures", study.pictures, "N",
                  "number of settings of each scene and camera whose pictures the page shows; 0: none",
                  kNotNegative, Recorded::no);
  options.flag("discard", study.discard, "remove photons and caches that no remaining setting reads",
               Recorded::no);
  options.flag("list", study.list, "print the commands that are still to be run, and run none", Recorded::no);
  tool.takes_strict(
      "run nothing and end with code 3 if something in a scene is lost or replaced (warnings name it)");
  options.example("phos-study room.toml -o room-study", "run it, or go on with it");
  options.example("phos-study room.toml -o room-study --list", "print the commands of the study");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
