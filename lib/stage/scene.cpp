#include "stage/scene.h"

#include <cstdio>

#include "radiance/gloss_report.h"
#include "scene/luminaire/photometric_file.h"
#include "scene/report/describe.h"
#include "scene/report/describe_text.h"
#include "scene/report/lint.h"

namespace phos::stage {
namespace {

void print(const std::string& out) {
  if (std::fwrite(out.data(), 1, out.size(), stdout) != out.size() || std::fflush(stdout) != 0)
    throw Error(ExitCode::bad_input, "stdout", "cannot be written; is the disk full?");
}

}  // namespace

void run(Tool& tool, const SceneCommand& asked) {
  if (is_photometry(asked.path)) {
    std::string option = tool.options().first_given_in("Scene");
    if (option.empty()) option = tool.options().first_given({"gloss", "strict"});
    if (!option.empty())
      throw Error(ExitCode::usage, option,
                  text("is for scenes; ", asked.path, " is a luminaire's photometry"));
    const Json description = describe_photometry(read_photometry(asked.path));
    return print(asked.json ? description.dump(2) + "\n" : photometry_text(description));
  }
  tool.reads("scene", scene_files(asked.path, asked.scene));
  const Scene scene = load_scene(asked.path, asked.scene);
  const std::vector<Finding> findings = lint_scene(scene);
  const Json report = gloss_report(scene, GlossTables(scene, {}, asked.gloss, {}, tool.counters()));
  Json description = describe_scene(scene, findings);
  add_gloss(description, report);
  std::string out = asked.json ? description.dump(2) + "\n" : describe_text(description);
  if (!asked.json && !report.as_array().empty())
    out += text("\nGloss (", report.as_array().size(), ")\n", gloss_text(report));
  print(out);
  for (const Finding& f : findings) {
    if (tool.strict() && f.level == Finding::Level::error) tool.set_exit(ExitCode::check_failed);
  }
  if (tool.strict() && refused(losses(scene)))
    throw Error(ExitCode::bad_input, asked.path, kRefusedForLosses);
}

}  // namespace phos::stage
