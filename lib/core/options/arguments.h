// The words of a command line, with files of options read.
#pragma once

#include <string>
#include <vector>

namespace phos {

/// Replaces each @file by the options it holds: one per line, `name=value`, `name value` or a flag; # starts
/// a comment. Adds the paths to `files`. Throws Error(bad_input) for a file that cannot be read or has more
/// than kMostOptionsFileBytes.
std::vector<std::string> expand_files(int argc, const char* const* argv, std::vector<std::string>& files);

}  // namespace phos
