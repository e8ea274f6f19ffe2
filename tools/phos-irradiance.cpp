// phos-irradiance: places irradiance records and estimates them.
#include "stage/irradiance.h"

#include "scene/rays.h"
#include "splat/gl/choice.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(
      program("phos-irradiance"),
      "Records are placed where photons landed, at given points, where a camera looks or on every surface, "
      "until "
      "each such place is within reach of one. A record holds the irradiance there with its standard error "
      "and "
      "gradients. Inputs, in any order: a scene; photons of it, unless rays gather the first bounce only or "
      "read a "
      "cache; an irradiance cache for rays to read where they land, in place of the coarse one that is "
      "otherwise made from the photons; and a radiance cache, for rays that land on gloss, whose records "
      "hold "
      "irradiance too, so that the surfaces which they cover get none of their own.",
      stage::kIrradianceAlgorithm);
  tool.takes_strict();
  stage::IrradianceCommand asked;
  Options& options = tool.options();
  options.inputs(
      "SCENE [PHOTONS] [CACHE] [RADIANCE] [BRDF]", asked.inputs,
      "scene (.glb, .gltf, .obj), photons of it, a cache of it to gather from, radiance records of "
      "it and the .brdf file that they were made with");
  declare_options(options, asked.scene);
  declare_options(options, asked.records);
  declare_raster_options(options, asked.records);
  declare_footprint_options(options, asked.records);
  declare_options(options, asked.placement);
  declare_isa(options, asked.isa);
  declare_gl(options, asked.gl);
  options.file(
      "at", asked.at,
      "CSV of points (x,y,z,nx,ny,nz) that need records, such as phos-splat --misses writes. Photons "
      "land on surfaces: --estimate hull and kernel put a point that is off a surface by up to a "
      "tenth of the default --min-radius on it, leave out one in free air with a warning, and end "
      "with code 3 where all are; gathered rays serve any point");
  options.file("add-to", asked.add_to,
               "irradiance file whose records are kept; the output may be the same file", FileUse::grown);
  options.flag("allow-mismatch", asked.allow_mismatch,
               "use photons of another scene or another version of it");
  options.example("phos-irradiance room.glb room.photons -o room.irradiance",
                  "records where the photons are");
  options.example("phos-irradiance room.glb room.photons --estimate gather --rays 1024 -o room.irradiance",
                  "the same by rays, which read a coarse cache made from the photons: best quality");
  options.example(
      "phos-irradiance room.glb room.photons --at misses.csv --add-to room.irradiance -o room.irradiance",
      "fills what a camera misses");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
