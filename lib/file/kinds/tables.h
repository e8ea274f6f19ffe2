// The table of the kinds of files.
#pragma once

#include <span>

#include "file/kinds/tensor_row.h"

namespace phos::inline file {

/// In order of FileKind.
std::span<const KindRow> all_kinds();

}  // namespace phos::inline file
