// phos-scene: checks a scene and shows the stages and settings that its light requires.
#include "stage/scene.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(
      program("phos-scene"),
      "Reads a glTF 2.0 or OBJ scene and prints its triangles, bounds, materials, lights with their lumens, "
      "cameras and animations; the stages and settings that its light requires, each with a reason; the "
      "method that computes the gloss of each glossy material; and findings: mistakes in units, missing "
      "normals, degenerate triangles, lamps that shine the wrong way, missing textures. For the photometry "
      "of a luminaire (IES LM-63, EULUMDAT) it prints lumens, maximum, beam and field angles, the luminous "
      "opening, and anything odd in the file. An OBJ scene NAME.obj shines by Ke, in cd/m2; its cameras and "
      "further lights stand in NAME.lights.json beside it: {\"lights\": [{\"name\": \"lamp\", \"kind\": "
      "\"point\", \"position\": [0, 2, 0], \"intensity\": 100}], \"cameras\": [{\"name\": \"view\", \"eye\": "
      "[0, 1.6, 3], \"target\": [0, 1, 0], \"up\": [0, 1, 0], \"yfov_deg\": 45, \"aspect\": 1}]}. Lengths "
      "are in m; an intensity is a number or RGB, in cd. A light of kind \"spot\" also has a \"direction\" "
      "and the half angles \"inner_deg\" and \"outer_deg\" in degrees; a light of kind \"directional\" has a "
      "\"direction\", and its intensity is in lx.",
      stage::kSceneAlgorithm, Tool::Output::none);
  stage::SceneCommand asked;
  tool.options().input("SCENE", asked.path, "glTF (.glb, .gltf) or OBJ scene; or photometry (.ies, .ldt)");
  declare_options(tool.options(), asked.scene);
  declare_options(tool.options(), asked.gloss);
  tool.options().section("Report");
  tool.options().flag("json", asked.json, "print one JSON object instead of text", Recorded::no);
  tool.takes_strict(
      "end with code 3 if something in the scene is lost or replaced, with code 1 if a finding is an error");
  tool.options().example("phos-scene room.glb", "contents and faults of a scene");
  tool.options().example("phos-scene lamp.ies", "lumens and angles of a luminaire");
  tool.options().example("phos-scene room.glb --json --strict > room.json", "for a script");
  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
