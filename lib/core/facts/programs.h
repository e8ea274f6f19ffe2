// The programs, in one table: for their help and manual pages, README.md and `phos help`.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace phos {

struct Program {
  std::string_view name;     ///< "phos-photons"
  std::string_view summary;  ///< follows the name in help: "traces photons ..."
  std::string_view reads, makes;
};

/// In the order of a study.
std::span<const Program> all_programs();
/// Null: there is none of that name. "photons" is "phos-photons".
const Program* find_program(std::string_view name);
/// The row of a program; aborts for a name that is not in the table.
const Program& program(std::string_view name);

/// The table of README.md, in Markdown.
std::string program_table();

}  // namespace phos
