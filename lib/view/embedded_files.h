// The files of lib/view/page, in the program.
#pragma once

#include <span>
#include <string_view>

namespace phos::inline view {

struct EmbeddedFile {
  std::string_view name;  ///< "view.js"
  std::string_view text;
};
/// Defined in a source that CMake makes (embed.cmake).
std::span<const EmbeddedFile> embedded_files();

}  // namespace phos::inline view
