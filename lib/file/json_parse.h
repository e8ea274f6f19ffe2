#pragma once

#include <string>
#include <string_view>

#include "core/json.h"

namespace phos::inline file {

/// Strict JSON. Throws Error(bad_input) with `where` and the byte at fault. Nesting deeper than 256 is an
/// error.
Json parse_json(std::string_view s, const std::string& where);

}  // namespace phos::inline file
