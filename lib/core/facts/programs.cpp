#include "core/facts/programs.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/text/markdown.h"

namespace phos {
namespace {

constexpr std::string_view kPrefix = "phos-";

constexpr Program kPrograms[] = {
    {"phos-scene", "checks a scene and shows the stages and settings that its light requires",
     "scene, luminaire", "text, JSON"},
    {"phos-photons", "traces photons from the lights and stores where they land", "scene", ".photons"},
    {"phos-merge", "joins the shards of a run into the file that the whole run would have made",
     "shards of one run", ".photons, .irradiance"},
    {"phos-irradiance", "places irradiance records and estimates them from photons or rays",
     "scene, photons, caches", ".irradiance"},
    {"phos-brdf", "projects glossy materials on hemispherical harmonics", "scene", ".brdf"},
    {"phos-radiance", "places radiance records on glossy surfaces and estimates them",
     "scene, photons, caches", ".radiance"},
    {"phos-temporal", "places records that live through the frames of an animation", "scene, .brdf",
     ".irradiance, .radiance"},
    {"phos-splat", "renders a scene from its caches", "scene, caches", ".exr"},
    {"phos-sense", "computes illuminance at sensor points, with its standard error", "scene, caches", ".csv"},
    {"phos-view", "shows a lit scene in a browser, to walk through", "scene, caches, photons",
     "web page, .irradiance"},
    {"phos-reference", "renders a scene by path tracing, as a reference for the other stages",
     "scene, photons", ".exr, .csv"},
    {"phos-bands", "joins results that were computed in bands of wavelength", ".exr, .csv", ".exr, .csv"},
    {"phos-compare", "measures how far an image is from a reference", ".exr, .hdr", "text, JSON, .exr"},
    {"phos-picture", "makes a picture from an image of light, or a plot from a table or a luminaire",
     ".exr, .hdr, .csv, luminaire", ".png, .hdr, .csv, .svg, video"},
    {"phos-plan", "chooses the pipeline and its settings for an error or a time", "scene", "shell script"},
    {"phos-study", "measures the time and the error of settings", "study file", ".csv, .html"},
    {"phos-info", "shows the contents and the origin of a phos file", "any phos file",
     "text, JSON, .csv, .ply"},
};

/// Endings of file names stand in backticks there.
std::string in_markdown(std::string_view words) {
  std::string s;
  bool inside = false;
  for (const char c : words) {
    if (c == '.' && !inside) s += '`', inside = true;
    if (c == ',' && inside) s += '`', inside = false;
    s += c;
  }
  return inside ? s + '`' : s;
}

}  // namespace

std::span<const Program> all_programs() { return kPrograms; }

const Program* find_program(std::string_view name) {
  if (name.starts_with(kPrefix)) name.remove_prefix(kPrefix.size());
  const auto* found = std::find_if(std::begin(kPrograms), std::end(kPrograms), [&](const Program& row) {
    return row.name.substr(kPrefix.size()) == name;
  });
  return found == std::end(kPrograms) ? nullptr : found;
}

const Program& program(std::string_view name) {
  const Program* found = find_program(name);
  PHOS_CHECK(found != nullptr, "\"", name, "\" is not in the table of programs");
  return *found;
}

std::string program_table() {
  std::vector<std::vector<std::string>> rows;
  for (const Program& row : kPrograms)
    rows.push_back(
        {text('`', row.name, '`'), in_markdown(row.reads), in_markdown(row.makes), std::string(row.summary)});
  return markdown_table({"program", "reads", "makes", "use"}, rows);
}

}  // namespace phos
