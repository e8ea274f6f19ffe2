#include "stage/brdf.h"

#include <algorithm>
#include <vector>

#include "file/atomic_file.h"
#include "image/image_provenance.h"
#include "radiance/brdf/bases.h"
#include "radiance/brdf/file.h"
#include "radiance/brdf/lamp_figure.h"
#include "radiance/brdf/projection.h"
#include "radiance/brdf/report.h"
#include "scene/rays.h"
#include "scene/report/describe.h"

namespace phos::stage {
namespace {

void draw_figure(Tool& tool, const Scene& scene, const BrdfCommand& asked) {
  const Tool::Timer timer = tool.time("figure");
  const RayScene rays(scene);
  LampFigure drawn = draw_lamp_figure(rays, asked.figure, static_cast<int>(asked.brdf.resolution));
  Json errors = Json::Array{};
  std::string said;  // of a material that is not lit the same for every order
  for (std::size_t i = 0; i < drawn.errors.size(); i += 2) {
    const FigureError &hsh = drawn.errors[i], &sh = drawn.errors[i + 1];
    if (const std::string sentence = sentence_of(hsh, sh); sentence != said) tool.say(said = sentence);
    for (const FigureError& e : {hsh, sh}) errors.push_back(figures_of(e));
    if (const std::uint64_t black = std::max(hsh.traced, sh.traced); black > 0)
      tool.warn(text(asked.figure.file, ": \"", hsh.material, "\", order ", hsh.order, ": ", black, " of ",
                     hsh.samples, " samples are black: their lobes are too intricate to project"));
  }
  tool.stat("figure", errors);
  set_provenance(drawn.image, tool.provenance(FileKind::image, scene.hash, scene.parts));
  write_exr(asked.figure.file, drawn.image);
  tool.say(text(asked.figure.file, ": ", drawn.image.width(), " x ", drawn.image.height()));
}

}  // namespace

void run(Tool& tool, const BrdfCommand& asked) {
  tool.add_input("scene", scene_files(asked.scene_path, asked.scene));
  check_usage(tool.options(), asked.figure);
  if (tool.options().given("reuse") && !(asked.bases.empty() && asked.figure.file.empty()))
    throw Error(ExitCode::usage, asked.bases.empty() ? "--figure" : "--bases",
                "is not written where nothing is made anew; leave out --reuse");
  if (tool.up_to_date()) return;
  const Scene scene = load_scene(asked.scene_path, asked.scene);
  tell_losses(tool, scene);
  if (!asked.figure.file.empty()) require_drawable(scene, asked.figure);
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
  if (!asked.figure.file.empty()) draw_figure(tool, scene, asked);
  if (!asked.bases.empty()) {
    const Tool::Timer timer = tool.time("bases");
    AtomicFile file(asked.bases);
    file.write(basis_accuracy_csv(scene, glossy_materials(scene)));
    file.commit();
  }
  write_brdf(tool.output(), tables, tool.provenance(FileKind::brdf, scene.hash, scene.parts));
}

}  // namespace phos::stage
