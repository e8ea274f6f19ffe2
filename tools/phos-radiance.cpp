// phos-radiance: places radiance records on glossy surfaces and estimates them.
#include "stage/radiance.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool("phos-radiance", "places radiance records on glossy surfaces and estimates them",
            "A radiance record holds the light that arrives from every direction, as hemispherical "
            "harmonics, with its standard error and gradients. Records are placed on materials whose lobes "
            "phos-brdf finds broad enough, each with the bands that its material needs, until each wanted "
            "place is within reach of one; other gloss is left to rays, and a scene without gloss gives an "
            "empty file. Inputs, in any order: a scene; photons of it, unless rays gather the first bounce "
            "only or read a cache; its .brdf file (else lobes are projected here); and caches for rays to "
            "read where they land: irradiance, in place of the coarse cache that is otherwise made from the "
            "photons, and radiance, for gloss.",
            stage::kRadianceAlgorithm);
  tool.takes_strict();
  stage::RadianceCommand asked;
  Options& options = tool.options();
  options.inputs(
      "SCENE [PHOTONS] [BRDF] [CACHE]", asked.inputs,
      "scene (.glb, .gltf, .obj), photons of it, its .brdf file, irradiance and radiance caches to gather "
      "from");
  declare_options(options, asked.scene);
  declare_options(options, asked.gloss);
  declare_options(options, asked.radiance);
  declare_place_options(options, asked.placement);
  declare_isa(options, asked.isa);
  options.file(
      "at", asked.at,
      "CSV of points (x,y,z,nx,ny,nz) that need records, such as phos-splat --gloss-misses writes. A "
      "point off a surface by up to a tenth of the default --min-radius is put on it; one in free "
      "air is left out with a warning, and where all are, the end is code 3");
  options.file("add-to", asked.add_to,
               "radiance file whose records are kept; the output may be the same file", FileUse::grown);
  options.flag("allow-mismatch", asked.allow_mismatch, "use files of another scene or another version of it");
  options.example("phos-radiance room.glb room.photons room.brdf -o room.radiance",
                  "where photons met gloss");
  options.example("phos-radiance room.glb room.photons room.brdf --place view --camera desk -o room.radiance",
                  "on the gloss that one camera sees");
  options.example(
      "phos-radiance room.glb room.photons room.brdf --at m.csv --add-to room.radiance -o room.radiance",
      "fills what a camera misses");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
