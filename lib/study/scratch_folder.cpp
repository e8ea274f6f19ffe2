#include "study/scratch_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/error.h"

namespace phos::inline study {
namespace {

constexpr const char* kPrefix = "phos-scratch-";

/// Opens a folder of ours and locks it; -1 where another holds it. `surely`: also where there are no locks.
int lock(const std::string& path, bool surely) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  struct stat info {};
  if (fd >= 0 && ::fstat(fd, &info) == 0 && info.st_uid == ::geteuid() &&
      (::flock(fd, LOCK_EX | LOCK_NB) == 0 || (!surely && errno != EWOULDBLOCK)))
    return fd;
  if (fd >= 0) ::close(fd);
  return -1;
}

void remove_abandoned(const std::filesystem::path& where) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(where, ignored)) {
    if (!entry.path().filename().string().starts_with(kPrefix)) continue;
    const int fd = lock(entry.path().string(), true);
    if (fd < 0) continue;
    std::filesystem::remove_all(entry.path(), ignored);
    ::close(fd);
  }
}

}  // namespace

ScratchFolder::ScratchFolder() {
  const std::filesystem::path where = std::filesystem::temp_directory_path();
  static const bool tidied = (remove_abandoned(where), true);
  static_cast<void>(tidied);
  do {  // another process that tidies up may take it before it is locked
    path_ = (where / kPrefix).string() + "XXXXXX";
    if (!::mkdtemp(path_.data())) throw Error(ExitCode::bad_input, path_, std::strerror(errno));
    lock_ = lock(path_, false);
    if (lock_ >= 0 && std::filesystem::exists(path_)) return;
    if (lock_ >= 0) ::close(lock_);
  } while (true);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  ::close(lock_);
}

}  // namespace phos::inline study
