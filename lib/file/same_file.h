// Which file a path leads to, whatever it is called.
#pragma once

#include <string>

namespace phos::inline file {

/// The same for all names of one regular file (links, ways through other folders), and for all names of
/// standard output. A file that is not there yet is told by its folder and name. "" for files that cannot be
/// lost by writing to them (a device, a pipe, standard error), for a folder, and where there is no such
/// folder.
std::string file_key(const std::string& path);

/// 1 or 2 where the path names that standard stream; else -1.
int standard_stream(const std::string& path);

}  // namespace phos::inline file
