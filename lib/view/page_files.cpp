#include "view/page_files.h"

#include <utility>

#include "core/error.h"
#include "image/false_colour.h"
#include "record/weight.h"
#include "splat/gl/shaders.h"
#include "view/embedded_files.h"
#include "view/message/format.h"

namespace phos::inline view {
namespace {

constexpr std::string_view kBinary = "application/octet-stream", kJson = "application/json";
constexpr std::string_view kText = "text/plain; charset=utf-8";

std::string_view type_of(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
  return kText;
}

std::string weight_glsl() {
  return text("const float kLeastWeight = ", std::scientific, kLeastWeight,
              ";\nconst float kGrowthLimit = ", kGrowthLimit, ";\n", shaders::record_weight);
}

std::string palette() {
  std::string bytes;
  for (int i = 0; i < 256; ++i)
    for (const std::uint8_t c : palette_colour(Palette::viridis, i / 255.0)) bytes += static_cast<char>(c);
  return bytes;
}

}  // namespace

PageFiles::PageFiles(std::string scene_message, std::string records_message, const Json& about) {
  for (const EmbeddedFile& file : embedded_files())
    files_[text('/', file.name)] = {type_of(file.name), std::string(file.text)};
  files_["/"] = files_.at("/index.html");
  files_["/weight.glsl"] = {kText, weight_glsl()};
  files_["/format.json"] = {kJson, message_format_json()};
  files_["/palette.bin"] = {kBinary, palette()};
  files_["/scene.bin"] = {kBinary, std::move(scene_message)};
  files_["/records.bin"] = {kBinary, std::move(records_message)};
  files_["/about.json"] = {kJson, about.dump()};
}

void PageFiles::add(const std::string& path, std::string message) {
  files_[path] = {kBinary, std::move(message)};
}

std::optional<ServedFile> PageFiles::find(std::string_view path) const {
  const auto found = files_.find(path);
  if (found == files_.end()) return std::nullopt;
  return ServedFile{found->second.type, found->second.bytes};
}

}  // namespace phos::inline view
