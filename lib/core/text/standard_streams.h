// Standard input, output and error of a program.
#pragma once

#include <string>

namespace phos {

/// Opens /dev/null for each of them that is closed: a file would take its number, and messages would be
/// written into that file.
void occupy_standard_streams();

/// One line on standard error, in one piece, so that lines of several programs do not mix.
void print_line(const std::string& line);

/// Flushes standard output. Throws Error(bad_input) where a part could not be written, as behind a
/// full disk.
void finish_stdout();

}  // namespace phos
