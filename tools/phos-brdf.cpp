// phos-brdf: projects the glossy materials of a scene on hemispherical harmonics.
#include "stage/brdf.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(
      program("phos-brdf"),
      "Finds, for each glossy material of the scene and each direction of view, the lowest order of "
      "harmonics that holds the cosine-weighted lobe, and the coefficients. Directions for which no order up "
      "to --max-order is enough are marked to be traced. Lambert parts, mirrors and smooth glass need no "
      "table; a scene without gloss gives an empty file. The file feeds phos-radiance and phos-splat. "
      "--figure "
      "draws the scene, lit by one lamp, exactly and through harmonics.",
      stage::kBrdfAlgorithm);
  stage::BrdfCommand asked;
  Options& options = tool.options();
  options.input("SCENE", asked.scene_path, "glTF (.glb, .gltf) or OBJ scene");
  declare_options(options, asked.brdf);
  declare_options(options, asked.scene);
  options.section("Output");
  options.file("bases", asked.bases,
               "write the share of each lobe's energy that given numbers of functions hold, for "
               "hemispherical harmonics and for rival bases, to this CSV",
               FileUse::written);
  declare_options(options, asked.figure);
  tool.takes_strict();
  options.example("phos-brdf room.glb -o room.brdf", "the lowest orders that hold 99 % of the energy");
  options.example("phos-brdf room.glb --error 0.01 --max-order 15 -o room.brdf", "sharper, at more cost");
  options.example("phos-brdf teapots.glb --figure lit.exr --figure-lamp -4,8,6 -o teapots.brdf",
                  "the scene lit by one lamp: exactly, through HSH and through SH");
  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
