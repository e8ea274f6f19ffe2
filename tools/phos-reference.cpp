// phos-reference: renders a scene by path tracing, or measures lux at points.
#include "stage/reference.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-reference"),
            "Unbiased path tracing with next-event estimation, multiple importance sampling and Russian "
            "roulette; it shares no estimator with the caches. --method bidirectional follows paths from the "
            "lamps too, and so finds light that comes by mirrors, glass and sharp gloss; light that no path "
            "can reach otherwise is blurred, and the estimated bias is part of the standard error. Writes an "
            "OpenEXR image with the layers beauty (R G B), emission, direct, indirect and, where there is "
            "any, glossy and specular in cd/m2, their standard errors stderr and indirect_stderr, albedo, "
            "normal, position and Z; or, with --points, a CSV of illuminance (lx) with its standard error.",
            stage::kReferenceAlgorithm, Tool::Output::optional);
  tool.takes_strict();
  Options& options = tool.options();
  stage::ReferenceCommand asked;
  options.input("SCENE", asked.scene_path, "glTF or OBJ scene");
  declare_options(options, asked.reference);
  declare_options(options, asked.scene);
  tool.takes_frames(asked.scene.frame);
  tool.fresh_each_frame(asked.reference);
  options.section("Points");
  options.file("points", asked.points,
               "measure illuminance at these points instead, on the side that the normal faces: CSV with the "
               "columns x,y,z,nx,ny,nz in metres, or six numbers a line; the result goes to -o or stdout");
  options.example("phos-reference room.glb --error 0.01 --samples 4096 -o room.exr",
                  "until the noise is 1 %");
  options.example("phos-reference room.glb --samples 256 --adaptive -o room.exr",
                  "most samples in the noisiest pixels: for scenes with small bright spots");
  options.example("phos-reference room.glb --bounces 1 -o direct.exr", "direct light only");
  options.example("phos-reference room.glb --points desk.csv --samples 65536",
                  "lux at sensor points, to stdout");
  options.example("phos-reference film.glb --frames 0:99 --samples 256 --reuse -o film/%04d.exr",
                  "an animation; frames that exist already stay as they are");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
