#include "study/pilot_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/error.h"

namespace phos {

ScratchFolder::ScratchFolder()
    : path_((std::filesystem::temp_directory_path() / "phos-pilot-XXXXXX").string()) {
  if (!::mkdtemp(path_.data())) throw Error(ExitCode::bad_input, path_, std::strerror(errno));
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace phos
