// The kinds of files, and the forms that files of one kind have.
#pragma once

#include <optional>
#include <string_view>

#include "core/json.h"

namespace phos::inline file {

enum class FileKind { photons, irradiance, radiance, brdf, image };
/// As `format` of a header says it: "photons".
const char* name_of(FileKind kind);
/// Nothing: no kind that this version knows.
std::optional<FileKind> kind_named(std::string_view name);

/// What of a run a file holds.
enum class FileForm {
  whole,  ///< all of it, of one scene
  shard,  ///< a share of the photons
  part,   ///< a share of the records (place/parts.h)
  film,   ///< records that each serve some frames (temporal/film/cache.h)
};
/// The entry of a header's extra values that says it: "shard", "part" (both hold "k/n") or "film"; "" for
/// whole.
const char* name_of(FileForm form);
/// `extra` as in Provenance.
FileForm form_of(const Json& extra);

}  // namespace phos::inline file
