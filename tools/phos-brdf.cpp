// Projects the glossy materials of a scene on hemispherical harmonics.
#include <cmath>

#include "cache/brdf_bases.h"
#include "cache/brdf_table.h"
#include "file/atomic_file.h"
#include "file/tool.h"
#include "scene/describe.h"
#include "scene/load.h"

namespace {

using namespace phos;

std::string percent(double share) { return text(std::round(1000 * share) / 10, " %"); }

std::string title(const BrdfTable& table) {
  return table.material.empty() ? text("material ", table.material_index) : text('"', table.material, '"');
}

std::string sentence(const BrdfTable& table, const std::string& model) {
  const BrdfSummary s = summarize(table);
  std::string out = text(title(table), ": ", model, table.isotropic ? ", " : ", anisotropic, ");
  if (s.greatest_order == 0) {
    out += "every direction is to be traced (--max-order or --error would have to be higher)";
  } else {
    out += text("orders ", s.least_order, " to ", s.greatest_order, ", mean ",
                std::round(10 * s.mean_order) / 10, "; ", percent(s.traced_share),
                " of directions traced; the others leave out ", percent(s.mean_error),
                " of the energy, at most ", percent(s.worst_error));
  }
  out += text("; ", s.bytes, " bytes");
  return table.note.empty() ? out : text(out, "; ", table.note);
}

Json figures(const BrdfTable& table, const std::string& model) {
  const BrdfSummary s = summarize(table);
  Json j;
  j["material"] = table.material;
  j["index"] = table.material_index;
  j["model"] = model;
  j["isotropic"] = table.isotropic;
  j["order_least"] = s.least_order;
  j["order_greatest"] = s.greatest_order;
  j["order_mean"] = s.mean_order;
  j["traced_share"] = s.traced_share;
  j["error_mean"] = s.mean_error;
  j["error_worst"] = s.worst_error;
  j["albedo"] = table.albedo;
  j["bytes"] = s.bytes;
  if (!table.note.empty()) j["note"] = table.note;
  return j;
}

void check_events(const Tool& tool, const BrdfTable& table, const Counters& counters) {
  if (const std::uint64_t n = counters[kGainsEnergyEvent]; n > 0) {
    tool.warn(text(title(table), " gains energy: it reflects up to ", table.albedo,
                   " of the light that reaches it (", n, " of ", table.entries(),
                   " directions above 1); lower its reflectances"));
  }
  if (const std::uint64_t n = counters[kIntricateLobeEvent]; n > 0) {
    tool.warn(text(title(table), " is too intricate for the quadrature towards ", n, " of ", table.entries(),
                   " directions: they are traced"));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("phos-brdf", "projects glossy materials on hemispherical harmonics",
            "For each glossy material of the scene, and each direction of view, finds the lowest order of "
            "harmonics that holds its cosine-weighted lobe, and the coefficients. Directions for which no "
            "order up to --max-order does are marked to be traced. Lambert parts, mirrors and smooth glass "
            "need no table; a scene without gloss gives an empty file. The file feeds phos-radiance and "
            "phos-splat.",
            1);
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
               "and of the bases they compete with (CSV)");
  options.example("phos-brdf room.glb -o room.brdf", "the lowest orders that keep 95 % of the energy");
  options.example("phos-brdf room.glb --error 0.01 --max-order 15 -o room.brdf", "sharper, at more cost");
  return tool.run(argc, argv, [&] {
    tool.add_input("scene", scene_files(scene_path, scene_options));
    if (options.given("reuse") && !bases_path.empty())
      throw Error(ExitCode::usage, "--bases", "is not written where nothing is made anew; leave out --reuse");
    if (tool.up_to_date()) return;
    const Scene scene = load_scene(scene_path, scene_options);
    std::vector<BrdfTable> tables;
    Json materials = Json::Array{};
    {
      const Tool::Timer timer = tool.time("project");
      for (const std::uint32_t material : glossy_materials(scene)) {
        Counters counters;
        const BrdfTable& table = tables.emplace_back(project_brdf(scene, material, brdf, counters));
        const std::string model = model_name(scene.material[material].model);
        tool.say(sentence(table, model));
        check_events(tool, table, counters);
        materials.push_back(figures(table, model));
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
