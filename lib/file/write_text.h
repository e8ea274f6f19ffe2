// Small files that are written at once.
#pragma once

#include <string>

namespace phos::inline file {

/// Writes the whole text, or nothing: see AtomicFile, with its errors.
void write_text(const std::string& path, const std::string& bytes);

}  // namespace phos::inline file
