// The kinds of files, and the forms that files of one kind have.
#pragma once

#include <optional>
#include <string_view>

#include "core/json.h"

namespace phos::inline file {

enum class FileKind { photons, irradiance, radiance, brdf, image };
/// The kind's name in `format` of a header: "photons".
const char* name_of(FileKind kind);
/// The kind of that name; nothing where this version knows no such kind.
std::optional<FileKind> kind_named(std::string_view name);

/// The part of a run that a file holds.
enum class FileForm {
  whole,  ///< the whole run, of one scene
  shard,  ///< a share of the photons
  part,   ///< a share of the records (place/parts.h)
  film,   ///< records that each serve some frames (temporal/film/cache.h)
};
/// The entry of a header's extra values that states the form: "shard", "part" (both hold "k/n") or "film"; ""
/// for whole.
const char* name_of(FileForm form);
/// The form that a header's extra values state; `extra` as in Provenance.
FileForm form_of(const Json& extra);

}  // namespace phos::inline file
