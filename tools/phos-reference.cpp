// phos-reference: renders a scene by path tracing or from a photon map, or measures lux at points.
#include "stage/reference.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-reference"),
            "Unbiased path tracing with next-event estimation, multiple importance sampling and Russian "
            "roulette; it shares no estimator with the caches. --method bidirectional follows paths from the "
            "lamps too, and so finds light that comes by mirrors, glass and sharp gloss; light that no path "
            "can reach otherwise is blurred, and the estimated bias is part of the standard error. --method "
            "final-gather and "
            "--method photons are the classical estimators over a photon map; they are biased, and their "
            "standard errors hold the noise alone. Writes an "
            "OpenEXR image with the layers beauty (R G B), emission, direct, indirect and, where there is "
            "any, glossy and specular in cd/m2, their standard errors stderr and indirect_stderr, albedo, "
            "normal, position and Z; or, with --points, a CSV of illuminance (lx) with its standard error.",
            stage::kReferenceAlgorithm, Tool::Output::optional);
  tool.takes_strict();
  Options& options = tool.options();
  stage::ReferenceCommand asked;
  options.inputs("SCENE [PHOTONS]", asked.inputs,
                 "scene (.glb, .gltf, .obj), and photons of it for --method final-gather and photons");
  declare_options(options, asked.reference);
  declare_options(options, asked.scene);
  tool.takes_frames(asked.scene.frame);
  tool.fresh_each_frame(asked.reference);
  options.section("Points");
  options.file("points", asked.points,
               "measure illuminance at these points instead, on the side that the normal faces: CSV with the "
               "columns x,y,z,nx,ny,nz in metres, or six numbers a line; the result goes to -o or stdout");
  options.flag("allow-mismatch", asked.allow_mismatch,
               "use photons of another scene or of another version of the scene", Recorded::if_given);
  options.example("phos-reference room.glb --error 0.01 --samples 4096 -o room.exr",
                  "until the noise is 1 %");
  options.example("phos-reference room.glb --samples 256 --adaptive -o room.exr",
                  "most samples in the noisiest pixels: for scenes with small bright spots");
  options.example("phos-reference room.glb --bounces 1 -o direct.exr", "direct light only");
  options.example("phos-reference room.glb --points desk.csv --samples 65536",
                  "lux at sensor points, to stdout");
  options.example("phos-reference room.glb room.photons --method final-gather --samples 16 -o gathered.exr",
                  "gathering at every pixel over a photon map");
  options.example("phos-reference film.glb --frames 0:99 --samples 256 --reuse -o film/%04d.exr",
                  "an animation; frames that exist already stay as they are");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
