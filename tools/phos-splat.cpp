// phos-splat: renders a scene from its caches.
#include "stage/splat.h"

#include "splat/gl/choice.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-splat"),
            "Draws every record of the caches over the visible surface, adds direct light by shadow rays and "
            "the reflections of mirrors, glass and glossy surfaces, and writes an OpenEXR image with the "
            "layers beauty (R G B), direct, indirect, glossy, specular, emission, stderr, albedo in cd/m2, "
            "illuminance.Y in lx, weight, normal, position (m, from the scene's origin where phos-scene "
            "shows one) and Z. Another camera, size or --accuracy needs no new cache.",
            stage::kSplatAlgorithm);
  tool.takes_strict();
  Options& options = tool.options();
  stage::SplatCommand asked;
  options.input("SCENE", asked.scene_path, "glTF or OBJ scene");
  options.inputs("CACHE", asked.caches,
                 "irradiance and radiance caches of the scene, which are joined, and its .brdf file for "
                 "radiance records and --environment-mode hsh (without one, lobes are projected here)");
  declare_options(options, asked.render);
  declare_gl(options, asked.gl);
  declare_options(options, asked.scene);
  tool.takes_frames(asked.scene.frame);
  tool.fresh_each_frame(asked.render);
  options.section("Output");
  options.choice<ExrCompression>(
      "compression", asked.compression,
      {{"zip", ExrCompression::zip}, {"piz", ExrCompression::piz}, {"none", ExrCompression::none}},
      "lossless compression of the EXR file: piz is the smallest, none the fastest");
  options.file("misses", asked.misses,
               "write the visible points without a record to this CSV, for phos-irradiance --at",
               FileUse::written);
  options.file(
      "gloss-misses", asked.gloss_misses,
      "write the visible glossy points without a radiance record to this CSV, for phos-radiance --at",
      FileUse::written);
  options.flag("allow-mismatch", asked.allow_mismatch,
               "accept a cache of another version of the scene, or radiance records with fewer bands than "
               "their lobes need; the image records this");
  options.example("phos-splat room.glb room.irradiance -o room.exr", "the first camera, 1000 pixels wide");
  options.example(
      "phos-splat room.glb room.irradiance --pixel-samples 1 --edge-samples 8 --layers beauty -o room.exr",
      "a quick picture: few samples but at edges, and no other layer");
  options.example("phos-splat room.glb room.irradiance --overlay records -o records.exr",
                  "places of the records, and the zone of each");
  options.example("phos-splat room.glb room.irradiance --camera desk --misses m.csv -o desk.exr",
                  "another camera from the same cache, and the points without a record");
  options.example("phos-splat film.glb film.irradiance --frames 0:99 -o film/%04d.exr",
                  "an animation; ranges may be given to several machines");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
