#include "file/folder.h"

#include <filesystem>

#include "core/error.h"

namespace phos::inline file {

void check_folder(const std::string& path) {
  std::error_code none;
  if (std::filesystem::exists(path, none) && !std::filesystem::is_directory(path, none))
    throw Error(ExitCode::bad_input, path, "is not a folder; name another with -o");
}

void make_folder(const std::string& path) {
  std::error_code failed;
  std::filesystem::create_directories(path, failed);
  if (failed || !std::filesystem::is_directory(path))
    throw Error(ExitCode::bad_input, path,
                text("cannot be a folder", failed ? ": " + failed.message() : "", "; name another with -o"));
}

}  // namespace phos::inline file
