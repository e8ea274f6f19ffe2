// phos-photons: traces photons from the lights and stores where they land.
#include "stage/photons.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-photons"),
            "Emits photons from every light of the scene, follows them from surface to surface (Russian "
            "roulette, no limit on bounces) and stores a photon on each surface that they reach. The file "
            "holds the photons and a kd-tree over them, and feeds phos-irradiance. The same command gives "
            "the same bytes on any number of threads.",
            stage::kPhotonsAlgorithm);
  stage::PhotonsCommand asked;
  tool.options().input("SCENE", asked.scene_path, "glTF (.glb, .gltf) or OBJ scene");
  declare_options(tool.options(), asked.photons);
  declare_options(tool.options(), asked.scene);
  tool.takes_strict();
  tool.options().example("phos-photons room.glb --photons 1000000 -o room.photons", "a million paths");
  tool.options().example("phos-photons room.glb --shard 1/2 -o a.photons",
                         "half of them, to be joined by phos-merge");
  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
