#include "stage/brdf.h"

#include <vector>

#include "file/atomic_file.h"
#include "radiance/brdf/bases.h"
#include "radiance/brdf/file.h"
#include "radiance/brdf/projection.h"
#include "radiance/brdf/report.h"
#include "scene/report/describe.h"

namespace phos::stage {
void run(Tool& tool, const BrdfCommand& asked) {
  tool.add_input("scene", scene_files(asked.scene_path, asked.scene));
  if (tool.options().given("reuse") && !asked.bases.empty())
    throw Error(ExitCode::usage, "--bases", "is not written where nothing is made anew; leave out --reuse");
  if (tool.up_to_date()) return;
  const Scene scene = load_scene(asked.scene_path, asked.scene);
  tell_losses(tool, scene);
  std::vector<BrdfTable> tables;
  Json materials = Json::Array{};
  {
    const Tool::Timer timer = tool.time("project");
    for (const std::uint32_t material : glossy_materials(scene)) {
      Counters counters;
      const BrdfTable& table = tables.emplace_back(project_brdf(scene, material, asked.brdf, counters));
      const std::string model = model_name(scene.material[material].model);
      tool.say(sentence_of(table, model));
      for (const std::string& warning : warnings_of(table, counters)) tool.warn(warning);
      materials.push_back(figures_of(table, model));
      tool.counters().merge(counters);
    }
  }
  if (tables.empty()) tool.say("the scene has no gloss, and the file is empty");
  tool.stat("materials", materials);
  if (!asked.bases.empty()) {
    const Tool::Timer timer = tool.time("bases");
    AtomicFile file(asked.bases);
    file.write(basis_accuracy_csv(scene, glossy_materials(scene)));
    file.commit();
  }
  write_brdf(tool.output(), tables, tool.provenance(FileKind::brdf, scene.hash, scene.parts));
}

}  // namespace phos::stage
