#include "stage/view/static.h"

#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "file/atomic_file.h"
#include "file/write_text.h"
#include "view/static/coding.h"
#include "view/static/static_page.h"

namespace phos::stage {
namespace {

std::string two_digits(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.2g", value);
  return digits;
}

Json provenance_of(const Tool& tool, const Scene& scene) {
  Json all = Json::Object{};
  for (const auto& [name, value] : to_metadata(tool.provenance(FileKind::image, scene.hash, scene.parts)))
    if (name != "format") all[name] = value;  // the page is no file of a kind
  return all;
}

}  // namespace

void require_static_options(Tool& tool, const ViewCommand& asked) {
  const Options& options = tool.options();
  if (asked.static_path.empty()) {
    if (options.given("static"))
      throw Error(ExitCode::usage, "--static", "is empty; name a file for the page");
    if (options.given("texture-size"))
      throw Error(ExitCode::usage, "--texture-size",
                  "is for --static FILE; the server gives textures as they are");
    return;
  }
  for (const char* section : {"Server", "Growth"})
    if (const std::string other = options.first_given_in(section); !other.empty())
      throw Error(ExitCode::usage, other,
                  "is of the server, and --static starts none; leave one of them out");
  require_writable(asked.static_path);
}

std::string precision_note(const Scene& scene) {
  double place_mm = 0, light_percent = 0;
  for (const CodedField& field : coded_fields()) {
    if (field.table == "vertex" && field.name == "position")
      place_mm = 1000 * static_cast<double>(max_component(scene.bounds.size())) / 2 /
                 (std::exp2(field.coding.bits) - 1);
    if (field.table == "record" && field.name == "irradiance")
      light_percent = 100 * std::exp2(-1. - field.coding.bits);
  }
  return text("the page holds rounded numbers: places to ", two_digits(place_mm),
              " mm, the light of records to ", two_digits(light_percent), " %");
}

void write_static_page(Tool& tool, const ViewCommand& asked, const Scene& scene, const PageFiles& files) {
  const std::string page = static_page(files, provenance_of(tool, scene));
  write_text(asked.static_path, page);
  tool.stat("page_bytes", page.size());
  tool.say(text(asked.static_path, ": ", two_digits(static_cast<double>(page.size()) / 1e6),
                " MB; a browser opens it from disk"));
}

}  // namespace phos::stage
