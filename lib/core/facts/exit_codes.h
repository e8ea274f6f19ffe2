// The meaning of each exit code, in one table: for every help text, docs/reference/exit-codes.md and
// `phos help exit-codes`.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/error.h"

namespace phos {

/// Texts are Markdown of one cell; cause and remedy may be empty.
struct ExitMeaning {
  ExitCode code;
  std::string_view meaning, cause, remedy;
};

/// One row for each ExitCode, in ascending order.
std::span<const ExitMeaning> exit_meanings();

/// The table of docs/reference/exit-codes.md, in Markdown.
std::string exit_code_table();

}  // namespace phos
