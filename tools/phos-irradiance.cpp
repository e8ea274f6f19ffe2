// phos-irradiance: places irradiance records and estimates them.
#include "stage/irradiance.h"

#include "scene/rays.h"
#include "splat/gl/choice.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(
      program("phos-irradiance"),
      "Places records where photons landed, at given points, where a camera looks or on every surface, until "
      "each such place is within reach of a record. A record holds the irradiance at its place with standard "
      "error and gradients. Inputs, in any order: a scene; photons of the scene, unless rays gather the "
      "first bounce only or read a cache; an irradiance cache, which rays read where they land instead of a "
      "coarse cache made from the photons; and a radiance cache, which rays read where they land on gloss. "
      "Radiance records hold irradiance too, so that surfaces which they cover get no irradiance records.",
      stage::kIrradianceAlgorithm);
  tool.takes_strict();
  stage::IrradianceCommand asked;
  Options& options = tool.options();
  options.inputs("SCENE [PHOTONS] [CACHE] [RADIANCE] [BRDF]", asked.inputs,
                 "scene (.glb, .gltf, .obj), its photons, an irradiance cache to gather from, its radiance "
                 "records, and the .brdf file that they were made with");
  declare_options(options, asked.scene);
  declare_options(options, asked.records);
  declare_raster_options(options, asked.records);
  declare_footprint_options(options, asked.records);
  declare_options(options, asked.placement);
  declare_isa(options, asked.isa);
  declare_gl(options, asked.gl);
  options.file("at", asked.at,
               "CSV of points (x,y,z,nx,ny,nz, in metres) that need records, such as the file of phos-splat "
               "--misses. With --estimate hull or kernel, a point that is off a surface by up to a tenth of "
               "the default --min-radius moves onto the surface; a point in free air is left out with a "
               "warning, with code 3 if all points are in free air; gathered rays serve any point");
  options.file("add-to", asked.add_to,
               "irradiance file whose records are kept and added to; the output may be the same file",
               FileUse::grown);
  options.flag("allow-mismatch", asked.allow_mismatch,
               "accept photons of another scene, or of another version of the scene");
  options.example("phos-irradiance room.glb room.photons -o room.irradiance",
                  "records where the photons are");
  options.example("phos-irradiance room.glb room.photons --estimate gather --rays 1024 -o room.irradiance",
                  "the same by rays, which read a coarse cache made from the photons: best quality");
  options.example(
      "phos-irradiance room.glb room.photons --at misses.csv --add-to room.irradiance -o room.irradiance",
      "fills what a camera misses");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
