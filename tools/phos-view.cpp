// phos-view: a walk through a lit scene in a browser.
#include "stage/view/view.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-view"),
            "Serves a page that a browser with WebGL 2 shows, and prints its address. The page draws the "
            "records of the caches as phos-splat does, with direct light by shadow maps. W, A, S and D walk, "
            "and dragging looks around. The panel shows illuminance and luminance under the cursor, with "
            "standard errors, which this program reads from the caches as phos-sense does. Only the page and "
            "the light of the named files are served. Ctrl-C ends the program.",
            stage::kViewAlgorithm, Tool::Output::none);
  tool.takes_strict();
  Options& options = tool.options();
  stage::ViewCommand asked;
  options.input("SCENE", asked.scene_path, "glTF or OBJ scene");
  options.inputs(
      "CACHE", asked.caches,
      "irradiance and radiance caches of the scene, which are joined; .brdf: lobes for the radiance "
      "records; NAME=CACHE names a group of lamps (caches made with --lamps), which the page dims by "
      "itself");
  options.section("Server");
  options.integer("port", asked.address.port, "N", "port; 0: any that is free", {0, 65535}, Recorded::no);
  options.text("host", asked.address.host, "ADDRESS",
               "address of this machine to serve at; 0.0.0.0 is all, and lets other machines in",
               Recorded::no);
  options.section("Picture");
  options.number(
      "accuracy", asked.accuracy, "A",
      "accuracy at which records are read (default: 2.5 times the cache's own, at most 0.5); the page "
      "has a slider for it",
      {0, 10, true}, Recorded::no);
  options.list("compare", asked.compare, "CACHE",
               "a second set of caches, CACHE or NAME=CACHE, which the page shows to the right of a wipe",
               Recorded::no);
  options.integer(
      "lamp-places", asked.lamp_places, "N",
      "shadow maps of each area lamp, and a quarter of those of a sky; fewer where there are many "
      "lamps",
      {1, 256}, Recorded::no);
  options.flag("allow-mismatch", asked.allow_mismatch, "accept caches of another version of the scene",
               Recorded::no);
  declare_options(options, asked.scene);
  options.example("phos-view room.glb room.irradiance", "then open http://127.0.0.1:8080/");
  options.example("phos-view room.glb desk=desk.irradiance ceiling=ceiling.irradiance",
                  "groups of lamps, dimmed live");
  options.example("phos-view room.glb room.irradiance --compare coarse.irradiance", "two caches by a wipe");
  options.example("phos-view room.glb room.irradiance --port 0", "any free port, which is printed");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
