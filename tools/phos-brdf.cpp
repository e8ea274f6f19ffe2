// Projects the glossy materials of a scene on hemispherical harmonics.
#include "file/atomic_file.h"
#include "file/tool.h"
#include "radiance/brdf/bases.h"
#include "radiance/brdf/report.h"
#include "radiance/brdf/table.h"
#include "scene/load.h"
#include "scene/report/describe.h"

using namespace phos;

int main(int argc, char** argv) {
  Tool tool("phos-brdf", "projects glossy materials on hemispherical harmonics",
            "For each glossy material of the scene, and each direction of view, finds the lowest order of "
            "harmonics that holds its cosine-weighted lobe, and the coefficients. Directions for which no "
            "order up to --max-order does are marked to be traced. Lambert parts, mirrors and smooth glass "
            "need no table; a scene without gloss gives an empty file. The file feeds phos-radiance and "
            "phos-splat.",
            2);
  std::string scene_path, bases_path;
  SceneOptions scene_options;
  BrdfTableOptions brdf;
  Options& options = tool.options();
  options.input("SCENE", scene_path, "glTF (.glb, .gltf) or OBJ scene");
  declare_options(options, brdf);
  declare_options(options, scene_options);
  options.section("Output");
  options.file("bases", bases_path,
               "write here how much of each lobe's energy so many functions hold, of hemispherical harmonics "
               "and of the bases they compete with (CSV)",
               FileUse::written);
  tool.takes_strict();
  options.example("phos-brdf room.glb -o room.brdf", "the lowest orders that keep 99 % of the energy");
  options.example("phos-brdf room.glb --error 0.01 --max-order 15 -o room.brdf", "sharper, at more cost");
  return tool.run(argc, argv, [&] {
    tool.add_input("scene", scene_files(scene_path, scene_options));
    if (options.given("reuse") && !bases_path.empty())
      throw Error(ExitCode::usage, "--bases", "is not written where nothing is made anew; leave out --reuse");
    if (tool.up_to_date()) return;
    const Scene scene = load_scene(scene_path, scene_options);
    tell_losses(tool, scene);
    std::vector<BrdfTable> tables;
    Json materials = Json::Array{};
    {
      const Tool::Timer timer = tool.time("project");
      for (const std::uint32_t material : glossy_materials(scene)) {
        Counters counters;
        const BrdfTable& table = tables.emplace_back(project_brdf(scene, material, brdf, counters));
        const std::string model = model_name(scene.material[material].model);
        tool.say(sentence_of(table, model));
        for (const std::string& warning : warnings_of(table, counters)) tool.warn(warning);
        materials.push_back(figures_of(table, model));
        tool.counters().merge(counters);
      }
    }
    if (tables.empty()) tool.say("nothing glossy here: the file is empty");
    tool.stat("materials", materials);
    if (!bases_path.empty()) {
      const Tool::Timer timer = tool.time("bases");
      AtomicFile file(bases_path);
      file.write(basis_accuracy_csv(scene, glossy_materials(scene)));
      file.commit();
    }
    write_brdf(tool.output(), tables, tool.provenance("brdf", scene.hash, scene.parts));
  });
}
