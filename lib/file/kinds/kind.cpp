#include "file/kinds/kind.h"

namespace phos::inline file {

namespace {

constexpr FileKind kKinds[] = {FileKind::photons, FileKind::irradiance, FileKind::radiance, FileKind::brdf,
                               FileKind::image};

}  // namespace

const char* name_of(FileKind kind) {
  constexpr const char* kNames[] = {"photons", "irradiance", "radiance", "brdf", "image"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::optional<FileKind> kind_named(std::string_view name) {
  for (const FileKind kind : kKinds)
    if (name == name_of(kind)) return kind;
  return std::nullopt;
}

const char* name_of(FileForm form) {
  constexpr const char* kNames[] = {"", "shard", "part", "film"};
  return kNames[static_cast<std::size_t>(form)];
}

FileForm form_of(const Json& extra) {
  for (const FileForm form : {FileForm::shard, FileForm::part, FileForm::film})
    if (extra.find(name_of(form)) != nullptr) return form;
  return FileForm::whole;
}

}  // namespace phos::inline file
