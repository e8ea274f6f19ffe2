#include <cstdio>

#include "file/tool.h"
#include "radiance/gloss_report.h"
#include "scene/load.h"
#include "scene/luminaire/photometric_file.h"
#include "scene/report/describe.h"
#include "scene/report/lint.h"

using namespace phos;

int main(int argc, char** argv) {
  Tool tool(
      "phos-scene", "checks a scene and says what computing its light requires",
      "Reads a glTF 2.0 or OBJ scene and prints its triangles, bounds, materials, lights with their lumens, "
      "cameras "
      "and animations; what its light requires, each with a reason; what computes the gloss of each glossy "
      "material; and findings: mistakes in units, missing normals, degenerate triangles, lamps that shine "
      "the "
      "wrong way, textures that are not there. Of a luminaire's photometry (IES LM-63, EULUMDAT) it prints "
      "lumens, "
      "maximum, beam and field angles, the luminous opening, and what is odd about the file. "
      "Cameras and lights of an OBJ scene NAME.obj stand in NAME.lights.json beside it (its surfaces shine "
      "by "
      "Ke, in cd/m2): {\"lights\": [{\"name\": \"lamp\", \"kind\": \"point\", \"position\": [0, 2, 0], "
      "\"intensity\": 100}], \"cameras\": [{\"name\": \"view\", \"eye\": [0, 1.6, 3], \"target\": [0, 1, 0], "
      "\"up\": [0, 1, 0], \"yfov_deg\": 45, \"aspect\": 1}]}. Lengths are in m; an intensity is a number or "
      "RGB, "
      "in cd. The kind \"spot\" has a \"direction\" and the half angles \"inner_deg\" and \"outer_deg\" too, "
      "\"directional\" a \"direction\" and its intensity in lx.",
      1, Tool::Output::none);
  std::string path;
  SceneOptions scene_options;
  bool json = false;
  GlossBy gloss = GlossBy::automatic;
  tool.options().input("SCENE", path, "glTF (.glb, .gltf) or OBJ scene; or photometry (.ies, .ldt)");
  declare_options(tool.options(), scene_options);
  declare_options(tool.options(), gloss);
  tool.options().section("Report");
  tool.options().flag("json", json, "print one JSON object instead of text", Recorded::no);
  tool.takes_strict(
      "end with code 3 where something of the scene is lost or replaced, with code 1 where a finding is an "
      "error");
  tool.options().example("phos-scene room.glb", "what is in it, and what is wrong with it");
  tool.options().example("phos-scene lamp.ies", "what a luminaire does");
  tool.options().example("phos-scene room.glb --json --strict > room.json", "for a script");
  const auto print = [](const std::string& out) {
    if (std::fwrite(out.data(), 1, out.size(), stdout) != out.size() || std::fflush(stdout) != 0)
      throw Error(ExitCode::bad_input, "stdout", "cannot be written; is the disk full?");
  };
  return tool.run(argc, argv, [&] {
    if (is_photometry(path)) {
      std::string option = tool.options().first_given_in("Scene");
      if (option.empty()) option = tool.options().first_given({"gloss", "strict"});
      if (!option.empty())
        throw Error(ExitCode::usage, option, text("is for scenes; ", path, " is a luminaire's photometry"));
      const Json description = describe_photometry(read_photometry(path));
      return print(json ? description.dump(2) + "\n" : photometry_text(description));
    }
    tool.reads("scene", scene_files(path, scene_options));
    const Scene scene = load_scene(path, scene_options);
    const std::vector<Finding> findings = lint_scene(scene);
    const Json report = gloss_report(scene, GlossTables(scene, {}, gloss, {}, tool.counters()));
    Json description = describe_scene(scene, findings);
    add_gloss(description, report);
    std::string out = json ? description.dump(2) + "\n" : describe_text(description);
    if (!json && !report.as_array().empty())
      out += text("\nGloss (", report.as_array().size(), ")\n", gloss_text(report));
    print(out);
    for (const Finding& f : findings) {
      if (tool.strict() && f.level == Finding::Level::error) tool.set_exit(ExitCode::check_failed);
    }
    if (tool.strict() && refused(losses(scene))) throw Error(ExitCode::bad_input, path, kRefusedForLosses);
  });
}
