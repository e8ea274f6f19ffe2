// The manual's page of file kinds, from the tables.
#pragma once

#include <string>

#include "file/kinds/tensor_row.h"

namespace phos::inline file {

/// The kind's line in the list of files of docs/reference/files.md.
std::string kind_line(const KindRow& kind);
/// The sections of all kinds that have tensors, in Markdown.
std::string kind_sections();

}  // namespace phos::inline file
