// Folders for results.
#pragma once

#include <string>

namespace phos::inline file {

/// Throws Error(bad_input) if there is something at `path` that is no folder.
void check_folder(const std::string& path);
/// Makes it where it is missing, and those that it lies in. Throws Error(bad_input) if it cannot be made.
void make_folder(const std::string& path);

}  // namespace phos::inline file
