// phos-radiance: places radiance records on glossy surfaces and estimates them.
#include "stage/radiance.h"

#include "splat/gl/choice.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(
      program("phos-radiance"),
      "A radiance record holds the light that arrives from every direction, as hemispherical harmonics, with "
      "standard error and gradients. Records are placed on materials whose lobes phos-brdf finds broad "
      "enough, each with the bands that its material needs, until each wanted place is within reach of a "
      "record; rays compute all other gloss, and a scene without gloss gives an empty file. Inputs, in any "
      "order: a scene; photons of the scene, unless rays gather the first bounce only or read a cache; its "
      ".brdf file (without one, lobes are projected here); and caches that rays read where they land: an "
      "irradiance cache instead of a coarse cache made from the photons, and a radiance cache for gloss.",
      stage::kRadianceAlgorithm);
  tool.takes_strict();
  stage::RadianceCommand asked;
  Options& options = tool.options();
  options.inputs("SCENE [PHOTONS] [BRDF] [CACHE]", asked.inputs,
                 "scene (.glb, .gltf, .obj), its photons, its .brdf file, and irradiance and radiance caches "
                 "to gather from");
  declare_options(options, asked.scene);
  declare_options(options, asked.gloss);
  declare_options(options, asked.store);
  declare_options(options, asked.radiance);
  declare_raster_options(options, asked.radiance.records, {Recorded::unless_default, Adopted::estimate});
  declare_radiance_footprint_options(options, asked.radiance.records);
  declare_place_options(options, asked.placement);
  declare_isa(options, asked.isa);
  declare_gl(options, asked.gl);
  options.file("at", asked.at,
               "CSV of points (x,y,z,nx,ny,nz, in metres) that need records, such as the file of phos-splat "
               "--gloss-misses. A point that is off a surface by up to a tenth of the default --min-radius "
               "moves onto the surface; a point in free air is left out with a warning, with code 3 if all "
               "points are in free air");
  options.file("add-to", asked.add_to,
               "radiance file whose records are kept and added to; the output may be the same file",
               FileUse::grown);
  options.flag("allow-mismatch", asked.allow_mismatch,
               "accept files of another scene, or of another version of the scene");
  options.example("phos-radiance room.glb room.photons room.brdf -o room.radiance",
                  "where photons met gloss");
  options.example("phos-radiance room.glb room.photons room.brdf --place view --camera desk -o room.radiance",
                  "on the gloss that one camera sees");
  options.example(
      "phos-radiance room.glb room.photons room.brdf --at m.csv --add-to room.radiance -o room.radiance",
      "fills what a camera misses");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
